//! For tests: colours as people see them, in CIELAB under D65, with normal and deficient colour vision.

use crate::style::Color;

/// A linear map of linear red, green, blue.
pub(crate) type Vision = [[f64; 3]; 3];

/// Normal colour vision.
pub(crate) const NORMAL: Vision = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// No long-wave cones: Machado, Oliveira and Fernandes (2009), table 1, severity 1.
pub(crate) const PROTANOPIA: Vision =
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]];
/// No middle-wave cones: the same table.
pub(crate) const DEUTERANOPIA: Vision =
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]];

/// No short-wave cones: the same table.
pub(crate) const TRITANOPIA: Vision =
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]];

/// From linear sRGB to CIE XYZ (IEC 61966-2-1).
const TO_XYZ: Vision =
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];

fn times(matrix: &Vision, vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

fn linear(color: Color) -> [f64; 3] {
    [color.0, color.1, color.2].map(|byte| {
        let coded = f64::from(byte) / 255.0;
        if coded <= 0.04045 { coded / 12.92 } else { math::pow((coded + 0.055) / 1.055, 2.4) }
    })
}

/// L*, a*, b* of a colour.
pub(crate) fn lab(color: Color, vision: &Vision) -> [f64; 3] {
    let seen = times(vision, linear(color)).map(|value| value.clamp(0.0, 1.0));
    let (xyz, white) = (times(&TO_XYZ, seen), times(&TO_XYZ, [1.0; 3]));
    let f = |value: f64| {
        if value > 216.0 / 24389.0 { math::pow(value, 1.0 / 3.0) } else { (24389.0 / 27.0 * value + 16.0) / 116.0 }
    };
    let [x, y, z] = [f(xyz[0] / white[0]), f(xyz[1] / white[1]), f(xyz[2] / white[2])];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Distance of two colours in CIELAB (1976).
pub(crate) fn difference(one: Color, other: Color, vision: &Vision) -> f64 {
    let (p, q) = (lab(one, vision), lab(other, vision));
    (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum::<f64>().sqrt()
}

/// Contrast of two colours as WCAG 2 defines it, from 1 to 21.
pub(crate) fn contrast(one: Color, other: Color) -> f64 {
    let luminance = |color: Color| times(&TO_XYZ, linear(color))[1] + 0.05;
    let (p, q) = (luminance(one), luminance(other));
    if p > q { p / q } else { q / p }
}
