//! What every host takes for granted of a declaration: judged by its uses alone.

use atrous::{Declaration, Lifetime, PassDecl, ResourceId, Use, UseFrame};
use std::collections::BTreeSet;

/// Names, phases, and what a pass reads and writes.
pub fn assert_is_sound(declaration: &Declaration) {
    let (resources, passes) = (declaration.resources(), declaration.passes());
    let names: BTreeSet<_> = resources.iter().map(|r| &r.name).collect();
    assert_eq!(names.len(), resources.len(), "two resources of one name");
    let names: BTreeSet<_> = passes.iter().map(|p| &p.name).collect();
    assert_eq!(names.len(), passes.len(), "two passes of one name");
    assert!(passes.windows(2).all(|pair| pair[0].phase <= pair[1].phase), "phases in order");
    let mut written: BTreeSet<u32> = BTreeSet::new();
    for pass in passes {
        for u in &pass.uses {
            let resource = resources.get(u.resource.0 as usize).expect("a resource of the declaration");
            let what = format!("{} uses {}", pass.name, resource.name);
            let is_input = matches!(resource.lifetime, Lifetime::Input { .. });
            assert!(!is_input || !u.access.writes(), "{what}, an input, to write it");
            if u.frame == UseFrame::Previous {
                assert!(resource.lifetime.is_history() && !u.access.writes(), "{what} of the frame before");
                // One copy holds the frame before until this frame writes it.
                let is_gone = resource.lifetime == Lifetime::HistoryInPlace && written.contains(&u.resource.0);
                assert!(!is_gone, "{what} of the frame before, which is overwritten");
            } else if u.access.reads() && !is_input {
                assert!(written.contains(&u.resource.0), "{what} before it is written");
            }
        }
        assert_is_free_of_hazards(declaration, pass);
        written.extend(pass.uses.iter().filter(|u| u.access.writes()).map(|u| u.resource.0));
    }
    for u in passes.iter().flat_map(|pass| &pass.uses).filter(|u| u.frame == UseFrame::Previous) {
        let name = &resources[u.resource.0 as usize].name;
        assert!(written.contains(&u.resource.0), "nothing writes {name}, of which the frame before is read");
    }
    let memory = declaration.memory();
    assert!(memory.transient <= memory.transient_unaliased, "aliasing takes more: {memory:?}");
    assert_eq!(memory.resources.len(), resources.len());
}

/// No two uses of one copy, of which one writes: nothing orders them inside a pass.
fn assert_is_free_of_hazards(declaration: &Declaration, pass: &PassDecl) {
    for (i, a) in pass.uses.iter().enumerate() {
        for b in &pass.uses[..i] {
            let resource = declaration.resource(a.resource);
            let one_copy = a.frame == b.frame || resource.lifetime == Lifetime::HistoryInPlace;
            let meets = a.resource == b.resource && one_copy && (a.access.writes() || b.access.writes());
            assert!(!meets, "{} uses {} twice, and writes it", pass.name, resource.name);
        }
    }
}

/// Of a graph whose transients have images of their own: whole contents that come first are read before others take their place.
pub fn assert_each_content_counts(declaration: &Declaration) {
    for (index, resource) in declaration.resources().iter().enumerate() {
        let is_of = |u: &&Use| u.resource == ResourceId(index as u32) && u.frame == UseFrame::Current;
        let mut unread: Option<&str> = None;
        for pass in declaration.passes() {
            for u in pass.uses.iter().filter(is_of) {
                if u.access.reads() {
                    unread = None;
                } else if let Some(first) = unread.replace(&pass.name) {
                    panic!("{} overwrites what {first} left in {}, and nothing read", pass.name, resource.name);
                }
            }
        }
    }
}
