//! The stability of a scene's uniform flow, in words.

use scene::uniform::Stability;

/// One line, for a ring of `count` pedestrians; `None` where there is no flow that could be stable.
pub fn in_words(flow: Option<Stability>, count: usize) -> String {
    let Some(Stability { speed, margin, margin_on_ring, growing, growth_rate, waves }) = flow else {
        return "no uniform flow with a linear response, so stability is undefined".to_owned();
    };
    let flow = format!("uniform flow at speed {speed:.6}");
    let wave = format!("the wave with {waves} period{}", if waves == 1 { "" } else { "s" });
    let on_ring = if margin_on_ring > 0.0 {
        format!("on this ring of {count} {wave} grows fastest, at rate {growth_rate:.4e}")
    } else {
        format!("on this ring of {count} every wave decays, {wave} most slowly, at rate {growth_rate:.4e}")
    };
    match growing {
        Some((least, largest)) => {
            let range =
                if least == 0.0 { format!("k < {largest:.4}") } else { format!("{least:.4} < k < {largest:.4}") };
            format!("{flow}: unstable (margin {margin:.4}), waves with {range} grow; {on_ring}")
        }
        None if margin == 0.0 => format!("{flow}: neutral (margin 0), no wave grows, but not all decay; {on_ring}"),
        None => format!("{flow}: stable (margin {margin:.4}), waves of all lengths decay; {on_ring}"),
    }
}
