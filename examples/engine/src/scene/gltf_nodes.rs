//! Checks that the nodes of a glTF file are trees, before they are walked: a node with two parents is visited twice, its children
//! four times, and so on.

use gltf::json::Root;

/// Every node has one parent or is a root of its scene once, as the format wants.
pub fn check_trees(root: &Root) -> Result<(), String> {
    let mut parents: Vec<Option<usize>> = vec![None; root.nodes.len()];
    for (parent, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten().map(|child| child.value()) {
            let limit = root.nodes.len();
            let place =
                parents.get_mut(child).ok_or_else(|| format!("node {parent} has a child {child}, where there are {limit}"))?;
            if let Some(other) = place.replace(parent) {
                return Err(format!("its nodes are no tree: node {child} is a child of node {other} and of node {parent} again"));
            }
        }
    }
    for (number, scene) in root.scenes.iter().enumerate() {
        let mut seen = vec![false; root.nodes.len()];
        for node in scene.nodes.iter().map(|node| node.value()) {
            let (Some(parent), Some(seen)) = (parents.get(node), seen.get_mut(node)) else {
                return Err(format!("scene {number} has a node {node}, where there are {}", root.nodes.len()));
            };
            if let Some(parent) = parent {
                return Err(format!("its nodes are no tree: node {node} is a root of scene {number} and a child of node {parent}"));
            }
            if std::mem::replace(seen, true) {
                return Err(format!("its nodes are no tree: scene {number} has node {node} twice"));
            }
        }
    }
    Ok(())
}
