//! The stability of a scene's uniform flow, in words.

use scene::uniform::Stability;

/// One line, for a ring of `count` pedestrians; `None` where there is no flow that could be stable.
pub fn in_words(flow: Option<Stability>, count: usize) -> String {
    let Some(Stability { speed, margin, margin_on_ring, growing, growth_rate, waves }) = flow else {
        return "no uniform flow with a response of its own: nothing to be stable".to_owned();
    };
    let flow = format!("uniform flow at speed {speed:.6}");
    let on_ring = if margin_on_ring > 0.0 {
        format!("on this ring {waves} in {count} grow fastest, at rate {growth_rate:.4e}")
    } else {
        format!("on this ring all decay, {waves} in {count} slowest, at rate {growth_rate:.4e}")
    };
    match growing {
        Some((least, largest)) => {
            let from = if least == 0.0 { "long ones".to_owned() } else { format!("k = {least:.4}") };
            format!("{flow}: unstable (margin {margin:.4}), waves from {from} to k = {largest:.4} grow; {on_ring}")
        }
        None if margin == 0.0 => format!("{flow}: neutral (margin 0), no wave grows, but not all decay; {on_ring}"),
        None => format!("{flow}: stable (margin {margin:.4}) for waves of all lengths; {on_ring}"),
    }
}
