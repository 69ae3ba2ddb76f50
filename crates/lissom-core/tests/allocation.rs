//! Nothing is allocated within a step.

use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::cell::Cell;

use lissom_core::compliance::Compliance;
use lissom_core::contact::forms::{Form, PlacedSolid, Solid};
use lissom_core::contact::law::{Coulomb, Impact};
use lissom_core::contact::set::{ContactRule, ContactSet, TouchLaw, TouchingPart};
use lissom_core::flexible::beam::SectionLaw;
use lissom_core::flexible::beam::line::{BeamLineDescription, beam_line};
use lissom_core::joints;
use lissom_core::kinematics::Freedoms;
use lissom_core::newton::Limits;
use lissom_core::registry::Parameters;
use lissom_core::scaling::ScalingChoice;
use lissom_core::schemes::{Scheme, backward_euler, energy_decaying, generalized_alpha, radau_iia};
use lissom_core::settings::Settings;
use lissom_core::simulation::Simulation;
use lissom_core::system::{Builder, Placement};
use lissom_motion::{Matrix6, Motion, Vector3};

struct Counting;

thread_local! {
    /// Allocations of this thread: the one that runs the tests has its own business.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes on to the system's allocator unchanged.
#[allow(unsafe_code, reason = "an allocator can only be counted from inside")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        unsafe { Heap.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { Heap.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    steps_with(&["hinge"]);
}

#[test]
fn a_step_with_redundant_constraints_allocates_nothing() {
    steps_with(&["hinge", "same hinge"]);
}

fn steps_with(hinges: &[&str]) {
    let decaying = energy_decaying::with_spectral_radius(0.0).expect("valid");
    for scheme in [
        generalized_alpha::hht(-0.1).expect("valid"),
        radau_iia::two_stages(),
        radau_iia::three_stages(),
        decaying,
    ] {
        let mut builder = Builder::new();
        builder.set_gravity(Vector3::new(0.0, -9.81, 0.0));
        let (contribution, line) = beam_line(
            builder.model(),
            &BeamLineDescription {
                name: "beam",
                elements: 4,
                order: 3,
                frame: &|s| Motion::translation(Vector3::new(s, 0.0, 0.0)),
                law: &|_| SectionLaw { damping: 1e-4, ..SectionLaw::elastic(Matrix6::identity() * 1e2) },
                mass: &|_, _| Matrix6::identity(),
                ends: [None, None],
            },
        );
        builder.add(contribution);
        let placement = Placement {
            nodes: [builder.ground(), line.nodes[0]],
            at: Vector3::zeros(),
            at_tip: None,
            axis: Some(Vector3::z()),
            second_axis: None,
        };
        let revolute = joints::KINDS.iter().find(|kind| kind.name == "revolute").expect("registered");
        for hinge in hinges {
            builder.add_joint(hinge, revolute, &placement, &Parameters::new()).expect("valid");
        }
        let mut simulation = simulation(builder, scheme);
        simulation.step().expect("converges");
        // Another step size asks for a new tangent sooner or later; schemes with a memory allocate at the change itself.
        simulation.set_step_size(1e-3);
        // Entries that vanish at the start join within the first steps.
        let allocated = allocated_after(&mut simulation, 5);
        assert!(simulation.totals().factorizations > 1, "a new tangent must be among the steps");
        assert_eq!(allocated, 0, "{}", simulation.settings().scheme.name);
    }
}

/// Balls that rest on a plane and on each other with friction.
#[test]
fn a_step_of_a_pile_at_rest_allocates_nothing() {
    let mut builder = Builder::new();
    builder.set_gravity(Vector3::new(0.0, 0.0, -9.81));
    let placed = |form| vec![PlacedSolid { frame: Motion::identity(), form }];
    let mut parts = vec![TouchingPart::new(builder.ground(), placed(Form::HalfSpace))];
    for (name, place) in [("left", [0.0, 0.0, 0.1]), ("right", [0.2, 0.0, 0.1]), ("top", [0.1, 0.0, 0.2732])]
    {
        let node = builder.add_node(name, Motion::translation(place.into()), Freedoms::Full);
        builder.add_inertia(node, &Matrix6::from_diagonal(&[1.0, 1.0, 1.0, 4e-3, 4e-3, 4e-3].into()));
        parts.push(TouchingPart::new(node, placed(Form::Solid(Solid::Sphere(0.1)))));
    }
    let law = TouchLaw {
        compliance: Compliance { stiffness: 1e5, exponent: 1.0 },
        impact: Impact::Dissipation(1.0),
        friction: Some(Coulomb { sliding: 0.5, at_rest: 0.5, stribeck: 0.01 }),
        surface: None,
    };
    let rule = ContactRule {
        name: "pile".to_owned(),
        parts: (0..parts.len()).collect(),
        groups: Vec::new(),
        law,
        materials: None,
    };
    *builder.contacts_mut() = ContactSet { parts, rules: vec![rule] };
    let mut simulation = simulation(builder, backward_euler::backward_euler());
    let allocated = allocated_after(&mut simulation, 200);
    assert!(simulation.state().touches.len() > 3, "{:?}", simulation.state().touches);
    assert_eq!(allocated, 0);
}

fn simulation(builder: Builder, scheme: Scheme) -> Simulation {
    let (system, state) = builder.build(0.0).expect("valid");
    let settings = Settings {
        scheme,
        step_size: 1e-2,
        control: None,
        scaling: ScalingChoice::default(),
        limits: Limits::default(),
        solver: lissom_solver::kind("sparse").expect("registered"),
        threads: 1,
        from_equilibrium: false,
        follow_drives: true,
        energy_check: true,
    };
    Simulation::new(system, state, settings).expect("consistent")
}

/// Allocations of twenty steps after `others`.
fn allocated_after(simulation: &mut Simulation, others: usize) -> usize {
    for _ in 0..others {
        simulation.step().expect("converges");
    }
    let before = COUNT.get();
    for _ in 0..20 {
        simulation.step().expect("converges");
    }
    COUNT.get() - before
}
