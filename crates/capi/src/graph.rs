//! Graphs of a host's own: nodes by name, ports by number, and shaders of the host between them.

mod arguments;
mod nodes;
#[cfg(test)]
mod tests;
mod values;

use crate::convert::{self, flag};
use crate::functions::string;
use crate::handle::{self, AtrousGraph};
use crate::pointers::read;
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::{AtrousArgument, AtrousCreateInfo, AtrousPort, AtrousStageInfo, ATROUS_NAME_SIZE};
use crate::AtrousConfig;
use arguments::{value_of, Arguments, Content};
use atrous::config::Preset;
use atrous::graph::{Graph, Stage};
use atrous::Declaration;
pub use nodes::{NodeInfo, NODES};
use std::collections::BTreeMap;
use std::ffi::c_char;
use std::sync::atomic::{AtomicU32, Ordering};
use values::Value;

/// The object behind a handle of a graph.
pub(super) struct GraphState {
    graph: Graph,
    /// The preset whose numbers the tuning begins with.
    preset: Preset,
    values: BTreeMap<AtrousPort, Value>,
}

impl GraphState {
    fn value(&self, what: &str, port: AtrousPort) -> Result<Value, Failure> {
        let missing =
            || Failure::argument(format!("{what}: port {port} is none of this graph; give what one of its nodes returned"));
        self.values.get(&port).cloned().ok_or_else(missing)
    }

    /// Keeps a value, under a number that no port of any graph had before; 0 is none.
    fn keep(&mut self, value: Value) -> AtrousPort {
        static NEXT: AtomicU32 = AtomicU32::new(1);
        if matches!(value, Value::Nothing) {
            return 0;
        }
        let port = NEXT.fetch_add(1, Ordering::Relaxed);
        self.values.insert(port, value);
        port
    }
}

/// The declaration that a host wants, of its graph or of its configuration, and the preset whose numbers its tuning begins with.
///
/// # Safety
/// The `config` of `info` is null or points to a struct that begins with its size.
pub(super) unsafe fn declaration_of(info: &AtrousCreateInfo) -> Result<(Declaration, Preset), Failure> {
    if info.graph.is_null() {
        // SAFETY: `config` is null or points to a struct that begins with its size.
        let config = unsafe { read("info->config", info.config)? }.to_config()?;
        return Ok((config.declare()?, config.preset));
    }
    if !info.config.is_null() {
        return Err(Failure::argument("info has both a config and a graph; leave config NULL, since the graph has one"));
    }
    let (declaration, preset) = handle::read(info.graph, |state| Ok((state.graph.clone().finish()?, state.preset)))?;
    let names = declaration.resources().iter().map(|resource| &resource.name);
    match names.chain(declaration.passes().iter().map(|pass| &pass.name)).find(|name| name.len() >= ATROUS_NAME_SIZE) {
        None => Ok((declaration, preset)),
        Some(name) => {
            let most = ATROUS_NAME_SIZE - 1;
            Err(Failure::argument(format!(
                "the name {name} has {} bytes; at most {most} fit: shorten it, or its scope",
                name.len()
            )))
        }
    }
}

/// Begins a graph of your own. Of the configuration it takes the extents, the conventions, frames_in_flight, and the preset whose
/// numbers the tuning begins with. Give the graph to atrous_create or atrous_executor_create, as often as you like; they tell mistakes
/// of the whole, with node and port.
///
/// # Safety
/// Pointers are null or valid with their struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_create(config: *const AtrousConfig, graph: *mut *mut AtrousGraph) -> AtrousStatus {
    guard(|| {
        if graph.is_null() {
            return Err(Failure::argument("graph is NULL; give a pointer to where the handle goes"));
        }
        // SAFETY: `graph` is not null and writable for a pointer; `config` is null or points to a struct that begins with its size.
        unsafe {
            graph.write_unaligned(std::ptr::null_mut());
            let config = read("config", config)?.to_config()?;
            let state = GraphState { graph: Graph::of(config.setup()), preset: config.preset, values: BTreeMap::new() };
            graph.write_unaligned(handle::insert(state));
        }
        Ok(())
    })
}

/// Destroys a graph. Denoisers that were made of it stay.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_destroy(graph: *mut AtrousGraph) -> AtrousStatus {
    guard(|| handle::remove(graph))
}

/// Adds one of ATROUS_NODE_*, with arguments by name. `scope` may be null; else its name follows those of the node's images and
/// passes, for a node that appears twice. `result`, which may be null, becomes the port that the node returns, or 0. A refused
/// call changes nothing.
///
/// # Safety
/// Strings are null or end in a null; `arguments` points to `count` of them; `result` is null or points to a port.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_node(
    graph: *mut AtrousGraph,
    node: *const c_char,
    scope: *const c_char,
    arguments: *const AtrousArgument,
    count: u32,
    result: *mut AtrousPort,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: each is null or a string with a null at its end, which lives through this call.
        let (node, scope) = unsafe { (string("node", node)?, scope_of(scope)?) };
        handle::change(graph, |state| {
            // SAFETY: `arguments` points to `count` of them, with strings that are null or end in a null.
            let mut arguments = unsafe { Arguments::read(&node, state, arguments, count)? };
            let mut changed = state.graph.clone();
            let added = scoped(&mut changed, scope.as_deref(), |graph| nodes::add(graph, &node, &mut arguments))?;
            arguments.finish()?;
            state.graph = changed;
            // SAFETY: `result` is null or points to a port.
            unsafe { give(state, added, result) };
            Ok(())
        })
    })
}

/// # Safety
/// `scope` is null or a string with a null at its end, which lives through this call.
unsafe fn scope_of(scope: *const c_char) -> Result<Option<String>, Failure> {
    // SAFETY: not null, so it is a string with a null at its end.
    let scope = (!scope.is_null()).then(|| unsafe { string("scope", scope) }).transpose()?;
    match scope.as_deref() {
        Some("") => Err(Failure::argument("scope is empty; give a name, or NULL for none")),
        _ => Ok(scope),
    }
}

fn scoped<T>(graph: &mut Graph, scope: Option<&str>, body: impl FnOnce(&mut Graph) -> T) -> T {
    match scope {
        Some(name) => graph.scope(name, body),
        None => body(graph),
    }
}

/// # Safety
/// `result` is null or points to a port that may be written.
unsafe fn give(state: &mut GraphState, value: Value, result: *mut AtrousPort) {
    let port = state.keep(value);
    if !result.is_null() {
        // SAFETY: not null, so it points to a port that may be written.
        unsafe { result.write_unaligned(port) };
    }
}

/// Adds a compute shader of yours as a stage. Its SPIR-V is for Vulkan 1.1 and has its names. Arguments are ports for its bindings
/// by their names, numbers or tunables for members of its push constants, and specialisation constants. Each storage image that it
/// writes and that you leave out is made for you. `result` becomes a port whose parts are the images that it writes:
/// atrous_graph_part. docs/add_a_stage.md has more. A refused call changes nothing.
///
/// # Safety
/// Pointers are null or valid, `info` with its struct_size set; strings end in a null; `arguments` points to `count` of them;
/// `spirv` of `info` points to `word_count` words. The SPIR-V is valid: the output of a compiler.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_stage(
    graph: *mut AtrousGraph,
    info: *const AtrousStageInfo,
    arguments: *const AtrousArgument,
    count: u32,
    result: *mut AtrousPort,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `info` is null or points to a struct that begins with its size, with a string and words as the host promised.
        let (info, name, spirv) = unsafe {
            let info = read("info", info)?;
            (info, string("info->name", info.name)?, words(&info)?)
        };
        let phase = convert::phase(info.phase)?;
        let stage = Stage::new(&name, &spirv)?;
        handle::change(graph, |state| {
            // SAFETY: `arguments` points to `count` of them, with strings that are null or end in a null.
            let arguments = unsafe { Arguments::read(&name, state, arguments, count)? };
            let mut changed = state.graph.clone();
            let mut call = changed.stage(&stage).phase(phase).per_block(info.per_block);
            if info.level > 0 {
                call = call.level(info.level);
            }
            for (argument, content) in arguments.all() {
                call = match &content {
                    Content::Port(value) => call.bind(&argument, image(&name, &argument, value)?),
                    Content::Previous(value) => call.previous(&argument, image(&name, &argument, value)?),
                    Content::Constant(value) => call.constant(&argument, *value),
                    Content::Number(_) | Content::Text(_) => {
                        let unknown =
                            || Failure::argument(format!("{name}: {argument} names no tunable: atrous_tuning_field lists them"));
                        call.value(&argument, value_of(&content).ok_or_else(unknown)?)
                    }
                };
            }
            let outputs = call.add();
            state.graph = changed;
            // SAFETY: `result` is null or points to a port.
            unsafe { give(state, outputs.into(), result) };
            Ok(())
        })
    })
}

/// # Safety
/// `spirv` of `info` is null or points to `word_count` words.
unsafe fn words(info: &AtrousStageInfo) -> Result<Vec<u32>, Failure> {
    const MOST: u64 = 1 << 22;
    if info.spirv.is_null() || !(1..=MOST).contains(&info.word_count) {
        let message = format!("info->spirv is NULL, or info->word_count is {}; give 1 to {MOST} words of SPIR-V", info.word_count);
        return Err(Failure::argument(message));
    }
    // SAFETY: not null, so it points to `word_count` words, and i is below that.
    Ok((0..info.word_count as usize).map(|i| unsafe { info.spirv.add(i).read_unaligned() }).collect())
}

fn image(stage: &str, binding: &str, value: &Value) -> Result<atrous::graph::Image, Failure> {
    value.image().ok_or_else(|| {
        Failure::argument(format!(
            "{stage}: {binding} is {}, which is not one image; take a part of it by atrous_graph_part: {}",
            value.name(),
            value.names_of_parts()
        ))
    })
}

/// A part of what a node returned: `first` and `second` of a port of two signals, an image of guides by its name, the image that a
/// stage wrote by the name of its binding. An error lists the parts that there are.
///
/// # Safety
/// `part` is null or ends in a null; `result` is null or points to a port.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_part(
    graph: *mut AtrousGraph,
    port: AtrousPort,
    part: *const c_char,
    result: *mut AtrousPort,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `part` is null or a string with a null at its end, which lives through this call.
        let part = unsafe { string("part", part)? };
        if result.is_null() {
            return Err(Failure::argument("result is NULL; give a pointer to a port"));
        }
        handle::change(graph, |state| {
            let value = state.value("port", port)?;
            let found = value.part(&part).ok_or_else(|| {
                let (name, parts) = (value.name(), value.names_of_parts());
                Failure::argument(format!("{name} has no part {part}; it has {parts}"))
            })?;
            // SAFETY: `result` is not null, so it points to a port.
            unsafe { give(state, found, result) };
            Ok(())
        })
    })
}

/// Makes an image an output of this name, which you allocate and read.
///
/// # Safety
/// `name` is null or ends in a null.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_output(graph: *mut AtrousGraph, name: *const c_char, port: AtrousPort) -> AtrousStatus {
    guard(|| {
        // SAFETY: `name` is null or a string with a null at its end, which lives through this call.
        let name = unsafe { string("name", name)? };
        handle::change(graph, |state| {
            let value = state.value(&name, port)?;
            match value.output(&mut state.graph, &name) {
                true => Ok(()),
                false => Err(Failure::argument(format!(
                    "{name}: port {port} is {}, which is no image; take a part of it by atrous_graph_part: {}",
                    value.name(),
                    value.names_of_parts()
                ))),
            }
        })
    })
}

/// Sets whether transients may lie in the images of outputs before those are written, which saves 8 bytes per pixel: 1, as from the
/// start, or 0, if you still read the outputs of the previous frame then.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_graph_share_outputs(graph: *mut AtrousGraph, on: u32) -> AtrousStatus {
    guard(|| {
        let on = flag("on", on)?;
        handle::change(graph, |state| {
            state.graph = state.graph.clone().share_outputs(on);
            Ok(())
        })
    })
}
