#!/usr/bin/env python3
"""Renders a scene of Blender for atrous-denoise: frames with the passes that it reads, and sequence.json with the cameras.

    blender -b SCENE.blend --python tools/blender_sequence.py -- -o FOLDER --samples 4
    python3 tools/blender_sequence.py SCENE.blend -o FOLDER --samples 4          # where the package bpy is installed
    cargo run --release -p atrous-denoise -- FOLDER -o DENOISED

Tried with Blender 3.4 (Debian 12) and bpy 4.5. What it changes in the scene: docs/denoise.md.
"""

import argparse
import json
import sys
from pathlib import Path

# Attributes of a view layer, by the pass that atrous-denoise reads.
PASSES = {
    "Combined": "use_pass_combined",
    "Depth": "use_pass_z",
    "Normal": "use_pass_normal",
    "Vector": "use_pass_vector",
    "IndexOB": "use_pass_object_index",
    "DiffDir": "use_pass_diffuse_direct",
    "DiffCol": "use_pass_diffuse_color",
    "GlossDir": "use_pass_glossy_direct",
    "GlossInd": "use_pass_glossy_indirect",
    "GlossCol": "use_pass_glossy_color",
    "Emit": "use_pass_emit",
    "Env": "use_pass_environment",
}
# The same of Cycles' own settings of a view layer. The denoising passes have the light that glass and hair pass on.
CYCLES_PASSES = ("denoising_store_passes", "use_pass_volume_direct", "use_pass_volume_indirect")
# The largest index that an object can have.
LARGEST_INDEX = 32767


def arguments(argv):
    parser = argparse.ArgumentParser(prog="blender_sequence.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    # Blender has opened its scene itself, and leaves what stands behind "--".
    if "--" in argv:
        argv = argv[argv.index("--") + 1:]
    else:
        parser.add_argument("scene", type=Path, help="the .blend file")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER", help="frames and sequence.json go here")
    parser.add_argument("--samples", type=int, help="samples per pixel and frame, at least 1; default: those of the scene")
    parser.add_argument("--start", type=int, help="first frame; default: that of the scene")
    parser.add_argument("--end", type=int, help="last frame; default: that of the scene")
    parser.add_argument("--no-render", action="store_true", help="only write sequence.json, and scene.blend to be rendered elsewhere")
    return parser.parse_args(argv)


def fail(message):
    sys.exit(f"blender_sequence.py: {message}")


def set_passes(scene):
    """Asks for every pass, in each view layer that is rendered."""
    for layer in (layer for layer in scene.view_layers if layer.use):
        for attribute in PASSES.values():
            setattr(layer, attribute, True)
        for attribute in CYCLES_PASSES:
            # Blender has moved some of them from one to the other.
            for owner in (layer.cycles, layer):
                if hasattr(owner, attribute):
                    setattr(owner, attribute, True)


def set_indices(objects):
    """Gives each object without an index one of its own, by which its history is told from that of others."""
    given = {o.pass_index for o in objects}
    free = (index for index in range(1, LARGEST_INDEX + 1) if index not in given)
    # By name: another run gives the same.
    for o in sorted((o for o in objects if o.pass_index == 0), key=lambda o: o.name):
        o.pass_index = next(free, 0)


def set_render(scene, samples):
    """One noisy picture a frame, not filtered, with noise that changes from frame to frame."""
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    # Cycles writes no Vector with motion blur.
    render.use_motion_blur = False
    # Files are what was rendered, all of it, from one eye.
    render.use_compositing = render.use_sequencer = render.use_border = render.use_multiview = False
    render.use_persistent_data = True
    cycles.use_denoising = False
    cycles.use_animated_seed = True
    if samples is not None:
        cycles.samples = samples
        cycles.use_adaptive_sampling = False
    image = render.image_settings
    # Blender 5 asks for the kind of file first.
    if hasattr(image, "media_type"):
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER"
    # Half floats end at 65504, before the depth of the sky, and have too few bits for positions.
    image.color_depth = "32"
    image.exr_codec = "ZIP"


def rows(matrix):
    return [[float(x) for x in row] for row in matrix]


def vulkan_clip(matrix):
    """Blender's projection has y up and depths from -1 to 1; here y is down, and they are from 0 to 1."""
    x, y, z, w = rows(matrix)
    return [x, [-v for v in y], [0.5 * (a + b) for a, b in zip(z, w)], w]


def camera_of(scene, depsgraph):
    """The matrices of the frame that the scene stands at."""
    render, camera = scene.render, scene.camera.evaluated_get(depsgraph)
    width, height = (int(side * render.resolution_percentage / 100) for side in (render.resolution_x, render.resolution_y))
    projection = camera.calc_matrix_camera(
        depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y
    )
    # The scale of a camera does not change its picture.
    return {"view": rows(camera.matrix_world.normalized().inverted()), "proj": vulkan_clip(projection)}


def check(scene, first, last, samples):
    if scene.camera is None:
        fail("the scene has no camera; choose one (Scene properties, Camera)")
    if scene.camera.data.type == "PANO":
        fail(f"the camera {scene.camera.name} is panoramic; its rays have no projection matrix. Use a perspective or orthographic one")
    if not 0 <= first <= last:
        fail(f"frames {first} to {last}: the first must be at least 0, and the last not before it")
    if samples is not None and samples < 1:
        fail(f"--samples is {samples}; it must be at least 1")


def sequence(bpy, options):
    """Frame by frame: its camera, and its picture unless that is left to others."""
    scene, frames = bpy.context.scene, []
    before = None
    for number in range(options.start, options.end + 1):
        scene.frame_set(number)
        check(scene, options.start, options.end, options.samples)
        frame = {"i": number, **camera_of(scene, bpy.context.evaluated_depsgraph_get())}
        # Markers bind cameras to frames.
        if before not in (None, scene.camera.name):
            frame["reset"] = True
        before = scene.camera.name
        frames.append(frame)
        if not options.no_render:
            scene.render.filepath = str(options.output / f"frame_{number:04}.exr")
            bpy.ops.render.render(write_still=True)
    return {"frames": frames}


def main():
    try:
        import bpy
    except ImportError:
        fail("there is no Blender here; run it with `blender -b SCENE.blend --python ...`, or install the package bpy")
    options = arguments(sys.argv[1:])
    if "scene" in options:
        bpy.ops.wm.open_mainfile(filepath=str(options.scene))
    scene = bpy.context.scene
    options.output = options.output.resolve()
    options.start = scene.frame_start if options.start is None else options.start
    options.end = scene.frame_end if options.end is None else options.end
    check(scene, options.start, options.end, options.samples)
    options.output.mkdir(parents=True, exist_ok=True)
    set_passes(scene)
    set_indices(bpy.data.objects)
    set_render(scene, options.samples)
    text = json.dumps(sequence(bpy, options), indent=1)
    (options.output / "sequence.json").write_text(text + "\n", encoding="utf-8")
    if options.no_render:
        scene.render.filepath = "//frame_####"
        scene.frame_start, scene.frame_end, scene.frame_step = options.start, options.end, 1
        bpy.ops.wm.save_as_mainfile(filepath=str(options.output / "scene.blend"), copy=True)


if __name__ == "__main__":
    main()
