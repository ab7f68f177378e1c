//! Colours as 8-bit sRGB and the two colour maps, as tables of equally spaced stops.

/// A colour in sRGB, one byte a channel: red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

impl Color {
    /// The colour as SVG writes it, for instance `#0a141e`.
    pub(crate) fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }

    /// The three bytes in the order red, green, blue.
    pub(crate) fn bytes(self) -> [u8; 3] {
        [self.0, self.1, self.2]
    }

    fn mix(self, other: Self, share: f64) -> Self {
        let channel = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
        Self(channel(self.0, other.0), channel(self.1, other.1), channel(self.2, other.2))
    }
}

/// Stops of the diverging map, from the lower end over the neutral middle to the upper end.
///
/// Computed in CIELAB (D65): lightness falls by equal steps of 7.75 from L* = 97 in the middle to
/// 35 at both ends, chroma grows as s^0.9 with the distance s from the middle to 50 below and 60
/// above, hue turns from 262 to 283 degrees (blue) below and from 58 to 35 degrees (red) above.
/// Blue against red survives the common kinds of colour blindness. Both arms are equally light at
/// equal distance from the middle, so a grey print tells the sign only by the zero contour and the
/// words in the regions.
pub(crate) const DIVERGING: [Color; 17] = [
    Color(0x01, 0x51, 0xa1),
    Color(0x33, 0x65, 0xad),
    Color(0x50, 0x79, 0xb9),
    Color(0x6b, 0x8d, 0xc5),
    Color(0x85, 0xa2, 0xd0),
    Color(0x9f, 0xb7, 0xdb),
    Color(0xbb, 0xcc, 0xe5),
    Color(0xd7, 0xe1, 0xef),
    Color(0xf6, 0xf6, 0xf6),
    Color(0xf1, 0xdc, 0xd2),
    Color(0xe8, 0xc3, 0xb2),
    Color(0xde, 0xaa, 0x94),
    Color(0xd3, 0x91, 0x78),
    Color(0xc7, 0x77, 0x5e),
    Color(0xba, 0x5e, 0x47),
    Color(0xac, 0x43, 0x31),
    Color(0x9d, 0x23, 0x1e),
];

/// Stops of the sequential map, dark to light: the part 0 to 0.8 of "viridis" by N. Smith and
/// S. van der Walt (public domain, CC0), cut where it would get too light for thin lines on white.
pub(crate) const SEQUENTIAL: [Color; 9] = [
    Color(0x44, 0x01, 0x54),
    Color(0x48, 0x24, 0x75),
    Color(0x41, 0x44, 0x87),
    Color(0x35, 0x5f, 0x8d),
    Color(0x2a, 0x78, 0x8e),
    Color(0x21, 0x91, 0x8c),
    Color(0x22, 0xa8, 0x84),
    Color(0x44, 0xbf, 0x70),
    Color(0x7a, 0xd1, 0x51),
];

/// The colour at `share` of the way along the stops; `share` is cut to [0, 1], NaN counts as 0.
pub(crate) fn along(stops: &[Color], share: f64) -> Color {
    let last = stops.len() - 1;
    let place = if share > 0.0 { share.min(1.0) * last as f64 } else { 0.0 };
    let below = (place as usize).min(last.saturating_sub(1));
    stops[below].mix(stops[(below + 1).min(last)], place - below as f64)
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
            for stop in [8 - step, 8 + step] {
                let expected = 97.0 - 7.75 * step as f64;
                let found = lab(DIVERGING[stop], &NORMAL)[0];
                // One byte of a channel is at most 0.4 in L*.
                assert!((found - expected).abs() < 0.4, "stop {stop}: L* {found}, {expected} wanted");
            }
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
