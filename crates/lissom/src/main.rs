//! Command line.
fn main() {
    let path = std::env::args().nth(1).expect("model");
    let text = std::fs::read_to_string(&path).expect("readable");
    let sets: Vec<(String, String)> = std::env::args().skip(2).map(|s| { let (a, b) = s.split_once('=').expect("path=value"); (a.to_owned(), b.to_owned()) }).collect();
    let registry = lissom_model::lower::registry::registry();
    let document = match lissom_model::Document::parse_with(&text, &path, &registry, &sets) {
        Ok(d) => d,
        Err(r) => { eprintln!("{}", r.render(false)); std::process::exit(2) }
    };
    let lowered = match lissom_model::lower::lower(&document) { Ok(d) => d, Err(r) => { eprintln!("{}", r.render(false)); std::process::exit(2) } };
    let plan = lowered.plan;
    let t0 = std::time::Instant::now();
    let mut sim = match lissom_core::analysis::Simulation::new(lowered.system, lowered.state, lowered.settings) { Ok(s) => s, Err(e) => { eprintln!("{e}"); std::process::exit(3) } };
    println!("prepared {:?} unknowns {} s {:e} rep {:?} vel {:e}", t0.elapsed(), sim.system().layout().size(), sim.scaled().scale(), sim.representative(), sim.velocity_correction());
    let t0 = std::time::Instant::now();
    let mut row = Vec::new();
    let every = (plan.steps / 40).max(1);
    for step in 0..=plan.steps {
        if step > 0 { if let Err(e) = sim.step() { eprintln!("{e}"); break } }
        if step % every == 0 {
            row.clear();
            for c in &lowered.channels { c.evaluate(sim.system(), sim.state(), &mut row); }
            println!("{:.6} {}", sim.state().kinematics.time, row.iter().take(8).map(|v| format!("{v:.9e}")).collect::<Vec<_>>().join(" "));
        }
    }
    println!("{:?} {:?} entries {}", t0.elapsed(), sim.totals(), sim.factor_entries());
}
