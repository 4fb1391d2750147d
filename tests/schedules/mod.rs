//! Any schedule that respects the declared uses gives the same bits: passes in another order, fewer barriers, other aliasing, one to
//! three frames in flight. The check of a plan is itself checked, with plans that are wrong.

mod host;
pub mod memory;
mod plan;

use super::graphs::{dice::Dice, inputs::Inputs, random};
use super::support::{assert_valid, gpu, scene::Scene, soak};
use atrous::executor::{Session, SessionOptions};
use atrous::{Declaration, FrameParams, Lifetime, ResourceDecl, Shape, Tuning, UseFrame};
use atrous_harness::DeviceTest;
use host::Host;
use plan::Plan;

pub const TESTS: &[DeviceTest] = &[
    ("a_plan_that_is_wrong_is_found", a_plan_that_is_wrong_is_found),
    ("any_schedule_gives_the_same_bits", any_schedule_gives_the_same_bits),
];

const EXTENT: [u32; 2] = [33, 21];

fn plan(declaration: &Declaration, seed: u32) -> Plan {
    Plan::random(declaration, &mut Dice::new(seed), |id| (declaration.resource(id).bytes(declaration.setup()), 64))
}

fn a_plan_that_is_wrong_is_found() {
    let mut orders = std::collections::BTreeSet::new();
    for seed in 0..12 {
        let declaration = random::declare(seed, EXTENT);
        let right = plan(&declaration, seed);
        assert_eq!(right.hazards(&declaration), [] as [String; 0], "seed {seed}");
        orders.insert(right.batches.concat().is_sorted());
        let mut joined = right.clone();
        joined.batches = vec![right.batches.concat()];
        assert!(!joined.hazards(&declaration).is_empty(), "seed {seed}: without barriers");
        let mut reversed = right.clone();
        reversed.batches.reverse();
        assert!(!reversed.hazards(&declaration).is_empty(), "seed {seed}: the other way round");
        let mut lacking = right.clone();
        lacking.batches.pop();
        assert!(!lacking.hazards(&declaration).is_empty(), "seed {seed}: without the last passes");
        let mut heaped = right;
        heaped.places.iter_mut().flatten().for_each(|place| place.0 = 0);
        assert!(!heaped.hazards(&declaration).is_empty(), "seed {seed}: all transients in one place");
    }
    assert!(orders.contains(&false), "no plan has another order than its declaration");
}

fn any_schedule_gives_the_same_bits() {
    for seed in 0..soak::times(4) {
        let declaration = random::declare(seed, EXTENT);
        let mut host = Host::new(&declaration, &mut Dice::new(1000 + seed));
        assert_eq!(host.plan.hazards(&declaration), [] as [String; 0], "seed {seed}");
        let options = SessionOptions { poison: true, ..Default::default() };
        let mut session = Session::new(gpu(), declaration.clone(), options).expect("session");
        let mut expected = Vec::new();
        for index in 0..4 {
            let scene = Scene { speed: 0.12, ..Scene::new(EXTENT) };
            let inputs = Inputs::new(&declaration, seed, &scene, index);
            let params = FrameParams { reshaded: true, ..scene.params(index) };
            host.frame(index, &params, &inputs);
            inputs.give_session(&mut session).expect("inputs");
            session.run(&params, &Tuning::default()).expect("a frame");
            expected.push(outputs(&mut session, &declaration));
        }
        for (index, (given, expected)) in host.outputs().into_iter().zip(expected).enumerate() {
            for ((name, given), (_, expected)) in given.into_iter().zip(expected) {
                assert!(
                    given == expected,
                    "seed {seed}, frame {index}: {name} has other bits in the order {:?}",
                    host.plan.batches
                );
            }
        }
    }
    assert_valid();
}

fn outputs(session: &mut Session, declaration: &Declaration) -> Vec<(String, Vec<u8>)> {
    let is_compared = |r: &&ResourceDecl| {
        r.lifetime == Lifetime::Output && matches!(r.shape, Shape::Image { .. }) && !r.name.starts_with("debug_view")
    };
    let names = declaration.resources().iter().filter(is_compared).map(|r| r.name.clone());
    names.map(|name| (name.clone(), session.download_bytes(&name, UseFrame::Current).expect(&name))).collect()
}
