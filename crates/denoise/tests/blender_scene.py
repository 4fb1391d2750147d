"""Makes the scene of tests/blender.rs: a moving cube and a ball on a floor, before a camera that moves and turns.

    blender -b --factory-startup --python blender_scene.py -- SCENE.blend [cut|blind|panorama]
"""

import math
import sys

import bpy


def add(primitive, name, **placed):
    getattr(bpy.ops.mesh, f"primitive_{primitive}_add")(**placed)
    bpy.context.object.name = name
    return bpy.context.object


def add_camera():
    bpy.ops.object.camera_add(location=(0, -8, 3), rotation=(math.radians(72), 0, 0))
    return bpy.context.object


def main(path, kind=""):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    # What is set here is what the script has to undo, or to keep.
    scene.render.use_motion_blur = scene.cycles.use_denoising = True
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 200, 150, 80
    scene.frame_start, scene.frame_end = 1, 3
    add("plane", "floor", size=20)
    add("uv_sphere", "ball", location=(1.2, 0, 1), segments=24, ring_count=12)
    cube = add("cube", "cube", size=1.5, location=(-1.2, 0, 0.75))
    bpy.ops.object.light_add(type="AREA", location=(3, -3, 5))
    bpy.context.object.data.energy = 500
    camera = add_camera()
    # A lens that is shifted, and a camera that is scaled: neither may spoil the matrices.
    camera.data.shift_x, camera.scale = 0.05, (2, 2, 2)
    for frame in range(scene.frame_start - 1, scene.frame_end + 2):
        camera.location.x = 0.1 * frame
        camera.rotation_euler.z = math.radians(0.5 * frame)
        cube.location.z = 0.75 + 0.05 * frame
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_euler", frame=frame)
        cube.keyframe_insert("location", frame=frame)
    scene.camera = None if kind == "blind" else camera
    if kind == "panorama":
        camera.data.type = "PANO"
    if kind == "cut":
        for frame, shown in [(1, camera), (2, add_camera())]:
            scene.timeline_markers.new("camera", frame=frame).camera = shown
    bpy.ops.wm.save_as_mainfile(filepath=path)


main(*sys.argv[sys.argv.index("--") + 1:])
