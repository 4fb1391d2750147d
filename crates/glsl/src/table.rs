//! Every variant of every shader to SPIR-V, with a table of what they are. A module is compiled when one of its sources changed.

use crate::compile::{resolve, shaders, Detail, Glsl, Variant};
use atrous_shader::{entry_point, interface, reflect, BindingKind, Shader};
use shaderc::Compiler;
use spirq::{ty::Type, var::Variable};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{env, error::Error, fs, time::UNIX_EPOCH};

/// Writes the modules into `out`, with the table `shaders.rs`, and the table `interfaces.rs` beside it. What belongs to one module
/// is kept in `modules` beside it from build to build.
pub fn write_table(glsl: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
    let modules_folder = out.with_file_name("modules");
    fs::create_dir_all(out)?;
    fs::create_dir_all(&modules_folder)?;
    let includes = [glsl.join("include")];
    let files = shaders(glsl)?;
    let sources = files.iter().map(|file| Source::read(file, &includes)).collect::<Result<Vec<_>, _>>()?;
    let variants: Vec<_> = sources.iter().flat_map(|source| source.variants.iter().map(move |variant| (source, variant))).collect();
    side_by_side(&variants, |compiler, (source, variant)| {
        let spirv = out.join(format!("{}.spv", variant.name));
        let [key_path, rest @ ..] = parts(&modules_folder, variant);
        let key = key(source.file, &includes, variant)?;
        if spirv.is_file() && fs::read_to_string(&key_path).ok().as_ref() == Some(&key) {
            return Ok(());
        }
        let module = module(source, compiler, variant)?;
        fs::write(&spirv, &module.bytes)?;
        for (path, text) in rest.iter().zip([&module.entry, &module.asserts, &module.interface]) {
            fs::write(path, text)?;
        }
        // Last, so that a build that was broken off is not taken for a whole one.
        Ok(fs::write(&key_path, key)?)
    })?;
    let (mut modules, mut asserts, mut interfaces, mut names) = (String::new(), BTreeSet::new(), String::new(), Vec::new());
    for source in &sources {
        let mut of_file = String::new();
        for variant in &source.variants {
            let [_, entry, assert, interface] = parts(&modules_folder, variant);
            of_file += &fs::read_to_string(entry)?;
            asserts.extend(fs::read_to_string(assert)?.lines().map(str::to_owned));
            interfaces += &fs::read_to_string(interface)?;
            names.push(&variant.name);
        }
        if let Some(unknown) = source.optional.iter().find(|name| !of_file.contains(&format!("{name:?}"))) {
            return Err(format!("{}: `// optional: {unknown}`, but there is no such binding", source.file.display()).into());
        }
        modules += &of_file;
    }
    for entry in fs::read_dir(out)?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if !names.iter().any(|n| name == format!("{n}.spv")) {
            fs::remove_file(entry.path())?;
        }
    }
    let mut table: String = asserts.into_iter().map(|line| line + "\n").collect();
    let constants: String = names.iter().map(|n| format!("&{}, ", n.to_uppercase())).collect();
    write!(table, "{modules}#[cfg(test)]\npub(crate) static ALL: &[&Shader] = &[{constants}];\n")?;
    fs::write(out.join("shaders.rs"), table)?;
    let interfaces = format!("pub(super) static INTERFACES: &[(&str, &[(&str, &str)])] = &[\n{interfaces}];\n");
    fs::write(out.with_file_name("interfaces.rs"), interfaces)?;
    Ok(())
}

/// A shader with what its own text says of it.
struct Source<'a> {
    file: &'a Path,
    glsl: Glsl,
    optional: Vec<String>,
    variants: Vec<Variant>,
}

impl<'a> Source<'a> {
    fn read(file: &'a Path, includes: &[PathBuf]) -> Result<Self, Box<dyn Error>> {
        let glsl = Glsl::read(file, includes)?;
        Ok(Self { file, optional: glsl.optional(), variants: glsl.variants(), glsl })
    }
}

/// Where the parts of a module are kept: its key, entry, asserts and interface.
fn parts(folder: &Path, variant: &Variant) -> [PathBuf; 4] {
    ["key", "rs", "asserts", "interface"].map(|part| folder.join(format!("{}.{part}", variant.name)))
}

/// Does the work of each item on as many threads as there are cores, each with a compiler of its own. Of several errors, gives that of the
/// first item.
fn side_by_side<T: Sync>(
    items: &[T],
    work: impl Fn(&Compiler, &T) -> Result<(), Box<dyn Error>> + Sync,
) -> Result<(), Box<dyn Error>> {
    let next = AtomicUsize::new(0);
    let thread = || -> Result<(), (usize, String)> {
        let compiler = Compiler::new().map_err(|e| (0, e.to_string()))?;
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(i) else { return Ok(()) };
            work(&compiler, item).map_err(|e| (i, e.to_string()))?;
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let results: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(thread)).collect();
        threads
            .into_iter()
            .map(|thread| thread.join().unwrap_or_else(|_| Err((0, "a thread of the compiler panicked".into()))))
            .collect()
    });
    match results.into_iter().filter_map(Result::err).min() {
        Some((_, error)) => Err(error.into()),
        None => Ok(()),
    }
}

/// The code of a module, and its lines of the tables.
struct Module {
    bytes: Vec<u8>,
    entry: String,
    asserts: String,
    interface: String,
}

fn module(source: &Source, compiler: &Compiler, variant: &Variant) -> Result<Module, Box<dyn Error>> {
    let stage = source.file.file_stem().unwrap_or_default().to_string_lossy();
    let name = &variant.name;
    let compile = |detail| source.glsl.compile(compiler, variant, detail).map_err(|e| format!("{name}:\n{e}"));
    let bytes: Vec<u8> = compile(Detail::Code)?.iter().flat_map(|word| word.to_ne_bytes()).collect();
    let named = compile(Detail::Everything)?;
    let shader = reflect(&stage, name, Vec::new(), &named, &source.optional)?;
    let interface = format!("({name:?}, &{:?}),\n", interface(&named)?);
    Ok(Module { bytes, entry: entry(&shader)?, asserts: asserts(&named)?, interface })
}

/// The sources of a module: the shader and every file that it includes, the macros, and this program.
fn key(file: &Path, includes: &[PathBuf], variant: &Variant) -> Result<String, Box<dyn Error>> {
    let program = fs::metadata(env::current_exe()?)?;
    let mut key = format!("{} {:?} {}\n", program.len(), program.modified()?.duration_since(UNIX_EPOCH)?, variant.name);
    let (mut found, mut left) = (BTreeSet::new(), vec![file.to_owned()]);
    while let Some(path) = left.pop() {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let named = text.lines().filter_map(|line| line.trim_start().strip_prefix("#include")?.split('"').nth(1));
        left.extend(named.map(|name| resolve(name, includes)).filter(|path| !found.contains(path)));
        found.insert(path);
    }
    for path in found {
        writeln!(key, "{}\n{}", path.display(), fs::read_to_string(&path).unwrap_or_default())?;
    }
    Ok(key)
}

/// The table entry of one module.
fn entry(shader: &Shader) -> Result<String, std::fmt::Error> {
    let Shader { stage, name, workgroup, bindings, members, constants, .. } = shader;
    let mut text = format!(
        "pub(crate) static {}: Shader = Shader {{\n    stage: Cow::Borrowed({stage:?}), name: Cow::Borrowed({name:?}), \
         spirv: Cow::Borrowed(include_bytes!({:?})), workgroup: {workgroup:?},\n    bindings: Cow::Borrowed(&[\n",
        name.to_uppercase(),
        format!("{name}.spv")
    );
    for b in bindings.iter() {
        let (number, name, kind, optional) = (b.number, &b.name, kind(b.kind), b.optional);
        writeln!(
            text,
            "        ShaderBinding {{ number: {number}, name: Cow::Borrowed({name:?}), kind: {kind}, optional: {optional} }},"
        )?;
    }
    text += "    ]),\n    members: Cow::Borrowed(&[\n";
    for m in members.iter() {
        let (name, offset, scalar) = (&m.name, m.offset, m.scalar);
        writeln!(text, "        PushMember {{ name: Cow::Borrowed({name:?}), offset: {offset}, scalar: Scalar::{scalar:?} }},")?;
    }
    text += "    ]),\n    constants: Cow::Borrowed(&[\n";
    for c in constants.iter() {
        let (name, id, scalar, default) = (&c.name, c.id, c.scalar, c.default);
        let of = format!("name: Cow::Borrowed({name:?}), id: {id}, scalar: Scalar::{scalar:?}, default: {default}");
        writeln!(text, "        SpecialisationConstant {{ {of} }},")?;
    }
    text += "    ]),\n};\n";
    Ok(text)
}

fn kind(kind: BindingKind) -> String {
    match kind {
        BindingKind::SampledImage(component) => format!("BindingKind::SampledImage(Component::{component:?})"),
        BindingKind::StorageImage(format, access) => {
            format!("BindingKind::StorageImage(TexelFormat::{format:?}, BindingAccess::{access:?})")
        }
        BindingKind::UniformBuffer => "BindingKind::UniformBuffer".into(),
        BindingKind::StorageBuffer(access) => format!("BindingKind::StorageBuffer(BindingAccess::{access:?})"),
    }
}

/// A block named like a Rust struct of the crate must have its layout.
fn asserts(spirv: &[u32]) -> Result<String, Box<dyn Error>> {
    const TWIN: &str = "FrameConstants";
    let mut text = String::new();
    for variable in &entry_point(spirv)?.vars {
        let Variable::Descriptor { ty: Type::Struct(block), .. } = variable else { continue };
        for member in block.members.iter().filter(|_| block.name() == Some(TWIN)) {
            let (field, offset) = (member.name.as_deref().unwrap_or_default(), member.offset.unwrap_or(0));
            writeln!(text, "const _: () = assert!(std::mem::offset_of!({TWIN}, {field}) == {offset});")?;
        }
    }
    Ok(text)
}
