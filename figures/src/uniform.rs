//! The stability of a scene's uniform flow, in words.

use scene::uniform::Stability;

/// Larger numbers are written with a power of ten.
pub(crate) const LONG: f64 = 1e15;

/// One line, for a ring of `count` pedestrians; `None` where there is no flow that could be stable.
pub fn in_words(flow: Option<&Stability>, count: usize) -> String {
    let Some(&Stability { speed, margin, margin_on_ring, ref growing, growth_rate, waves }) = flow else {
        return "no uniform flow with a linear response, so stability is undefined".to_owned();
    };
    let flow = if speed.abs() < LONG { format!("{speed:.6}") } else { format!("{speed:e}") };
    let flow = format!("uniform flow at speed {flow}");
    let wave = format!("the wave with {waves} period{}", if waves == 1 { "" } else { "s" });
    let on_ring = if margin_on_ring > 0.0 {
        format!("on this ring of {count} {wave} grows fastest, at rate {growth_rate:.4e}")
    } else if margin_on_ring < 0.0 {
        format!("on this ring of {count} every wave decays, {wave} most slowly, at rate {growth_rate:.4e}")
    } else {
        format!("on this ring of {count} no wave grows, but not all decay")
    };
    if growing.is_empty() && margin < 0.0 {
        return format!("{flow}: stable (margin {}), waves of all lengths decay; {on_ring}", digits(margin));
    }
    if growing.is_empty() {
        return format!("{flow}: neutral (margin 0), no wave grows, but not all decay; {on_ring}");
    }
    let bands: Vec<String> = growing.iter().map(|band| range(*band)).collect();
    format!("{flow}: unstable (margin {}), waves with {} grow; {on_ring}", digits(margin), bands.join(" or "))
}

/// A band of wave numbers.
fn range((least, largest): (f64, f64)) -> String {
    match least {
        0.0 => format!("k < {}", digits(largest)),
        _ => format!("{} < k < {}", digits(least), digits(largest)),
    }
}

/// A number with four decimals, or with four digits where that would leave few.
fn digits(number: f64) -> String {
    if number.abs() < 0.01 { format!("{number:.3e}") } else { format!("{number:.4}") }
}
