//! The two colour maps, as tables of equally spaced stops.

use crate::style::Color;

/// Stops of the diverging map, from the lower end over the neutral middle to the upper end.
///
/// Computed in CIELAB (D65): lightness falls by equal steps from L* = 97 in the middle to 58 at the lower end and 35 at
/// the upper one, chroma grows as s^0.9 with the distance s from the middle to 46 below and 60 above, hue turns from
/// 262 to 283 degrees (blue) below and from 58 to 35 degrees (red) above. Blue against red survives the common kinds of
/// colour blindness. The upper arm becomes darker, so that a grey print also distinguishes the signs.
pub(crate) const DIVERGING: [Color; 17] = colors([
    0x668ada, 0x7598df, 0x85a5e4, 0x95b3e9, 0xa7c1ed, 0xb9cef0, 0xccdcf3, 0xe0e9f6, 0xf6f6f6, 0xf1dcd2, 0xe8c3b2,
    0xdeaa94, 0xd39178, 0xc7775e, 0xba5e47, 0xac4331, 0x9d231e,
]);

/// Stops of the sequential map, dark to light: the part 0 to 0.8 of "viridis" by N. Smith and S. van der Walt (public
/// domain, CC0), cut where it would get too light for thin lines on white.
pub(crate) const SEQUENTIAL: [Color; 9] =
    colors([0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c, 0x22a884, 0x44bf70, 0x7ad151]);

const fn colors<const N: usize>(hexadecimal: [u32; N]) -> [Color; N] {
    let mut colors = [Color(0, 0, 0); N];
    let mut index = 0;
    while index < N {
        let [_, red, green, blue] = hexadecimal[index].to_be_bytes();
        colors[index] = Color(red, green, blue);
        index += 1;
    }
    colors
}

/// The colour at `share` of the way along the stops; `share` is cut to [0, 1], NaN counts as 0.
pub(crate) fn along(stops: &[Color], share: f64) -> Color {
    let last = stops.len() - 1;
    let place = if share > 0.0 { if share < 1.0 { share * last as f64 } else { last as f64 } } else { 0.0 };
    let below = (place as usize).min(last.saturating_sub(1));
    mix(stops[below], stops[(below + 1).min(last)], place - below as f64)
}

fn mix(one: Color, other: Color, share: f64) -> Color {
    let channel = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
    Color(channel(one.0, other.0), channel(one.1, other.1), channel(one.2, other.2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::{DEUTERANOPIA, NORMAL, PROTANOPIA, difference, lab};

    #[test]
    fn both_arms_darken_evenly_from_a_neutral_middle() {
        let [light, a, b] = lab(DIVERGING[8], &NORMAL);
        assert!(light > 96.0 && a.abs() < 1.0 && b.abs() < 1.0, "{light} {a} {b}");
        for step in 1..=8 {
            for (stop, fall) in [(8 - step, 39.0 / 8.0), (8 + step, 62.0 / 8.0)] {
                let expected = 97.0 - fall * step as f64;
                let found = lab(DIVERGING[stop], &NORMAL)[0];
                // One byte of a channel is at most 0.4 in L*.
                assert!((found - expected).abs() < 0.4, "stop {stop}: L* {found}, {expected} wanted");
            }
        }
    }

    #[test]
    fn the_sign_shows_in_a_grey_print() {
        let light = |stop: usize| lab(DIVERGING[stop], &NORMAL)[0];
        for step in 4..=8 {
            let apart = light(8 - step) - light(8 + step);
            assert!(apart > 11.0, "step {step}: {apart} in L*");
        }
    }

    #[test]
    fn the_sign_shows_to_colour_blind_readers() {
        for vision in [PROTANOPIA, DEUTERANOPIA] {
            for step in 1..=8 {
                let apart = difference(DIVERGING[8 - step], DIVERGING[8 + step], &vision);
                // 2.3 is just noticeable.
                assert!(apart > 10.0, "step {step}: {apart}");
            }
        }
    }

    #[test]
    fn the_sequential_map_brightens_steadily() {
        let lights: Vec<f64> = SEQUENTIAL.iter().map(|stop| lab(*stop, &NORMAL)[0]).collect();
        assert!(lights.windows(2).all(|pair| pair[1] - pair[0] > 5.0), "{lights:?}");
        assert!(lights[8] < 78.0, "too light on white: {lights:?}");
    }

    #[test]
    fn stops_and_middles_of_a_map() {
        let stops = [Color(0, 0, 0), Color(100, 200, 50), Color(255, 255, 255)];
        assert_eq!(along(&stops, 0.25), Color(50, 100, 25));
        assert_eq!(along(&stops, 0.5), stops[1]);
        assert_eq!((along(&stops, -3.0), along(&stops, 7.0), along(&stops, f64::NAN)), (stops[0], stops[2], stops[0]));
    }
}
