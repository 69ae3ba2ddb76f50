//! Nothing is allocated within a step.

use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::cell::Cell;

use lissom_core::elements::beam::SectionLaw;
use lissom_core::elements::beam::line::{BeamLineDescription, beam_line};
use lissom_core::joints;
use lissom_core::newton::Limits;
use lissom_core::registry::Parameters;
use lissom_core::scaling::ScalingChoice;
use lissom_core::schemes::{energy_decaying, generalized_alpha, radau_iia};
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
                law: &|_| SectionLaw { stiffness: Matrix6::identity() * 1e2, damping: 1e-4 },
                mass: &|_| Matrix6::identity(),
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
        let mut simulation = Simulation::new(system, state, settings).expect("consistent");
        simulation.step().expect("converges");
        // Another step size asks for a new tangent sooner or later; schemes with a memory allocate at the change itself.
        simulation.set_step_size(1e-3);
        // Entries that vanish at the start join within the first steps.
        for _ in 0..5 {
            simulation.step().expect("converges");
        }
        let before = COUNT.get();
        for _ in 0..20 {
            simulation.step().expect("converges");
        }
        let allocated = COUNT.get() - before;
        assert!(simulation.totals().factorizations > 1, "a new tangent must be among the steps");
        assert_eq!(allocated, 0, "{}", simulation.settings().scheme.name);
    }
}
