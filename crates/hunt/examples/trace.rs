//! trace
use reference::flow::*; use reference::solver::*;
fn main() {
    let seed: u64 = std::env::args().nth(1).unwrap().parse().unwrap();
    let form = if std::env::args().nth(2).unwrap() == "c" { Form::Clearances } else { Form::Differences };
    let q: reference::solution::Question = hunt::question::read(&hunt::draw::scene(seed), "main").unwrap();
    let flow: Flow<f64> = Flow::new(q.formula, q.pedestrians, q.length, form);
    let mut s = Solver::new(flow, flow.start(q.shift), Care { nodes: 12, tolerance: std::env::args().nth(3).unwrap().parse().unwrap(), most_work: 10_000_000 });
    let mut k = 0u64;
    loop {
        let r = s.advance(1e3);
        k += 1;
        let vmax = (0..q.pedestrians).map(|n| flow.speed(&s.state, n).abs()).fold(0.0, f64::max);
        if k % 200 == 0 || r.is_err() || k < 10 { println!("{k} t={:?} h={:e} work={} room={:e} vmax={:e}", f64::from(s.time), s.length, s.work, flow.least_room(&s.state), vmax); }
        if r.is_err() { println!("{r:?}"); break }
    }
}
