//! Small pictures of every kind, from made-up data.

use plot::{
    Axis, Color, ColorScale, Corner, Drawing, Legend, Lines, Map, Marker, Picture, Point, Series, SpaceTime, Trajectory,
};

fn line(count: u32, value: impl Fn(f64) -> f64) -> Vec<Point> {
    (0..=count).map(|i| f64::from(i) / f64::from(count)).map(|x| (x, value(x))).collect()
}

/// Two panels of curves with markers, guides, notes, an inset and both kinds of legend.
pub fn curves() -> Picture {
    let inset = Lines::new(Axis::linear("$t$", 0.0, 1.0), Axis::log10("", 1e-6, 1.0))
        .series(Series::line("", line(50, |x| math::exp(-12.0 * x))));
    let left =
        Lines::new(Axis::linear(r"$\Delta x'_n$", 0.0, 1.0), Axis::linear(r"$\mathrm{std}(\tilde v)$", 0.0, 1.0))
            .series(Series::line("curve", line(50, |x| 0.2 * x)))
            .series(Series::points("published", Marker::Square, line(10, |x| 0.2 * x)))
            .legend(Legend::Corner(Corner::TopLeft))
            .horizontal(0.1)
            .note("half", (0.1, 0.12))
            .inset([0.4, 0.35, 0.98, 0.97], inset);
    let right = Lines::new(Axis::log10("work", 1e2, 1e5), Axis::log10("error", 1e-9, 1.0))
        .series(Series::line("first", vec![(2e2, 1e-1), (5e4, 1e-3)]).marker(Marker::Circle))
        .series(Series::line("second", vec![(2e2, 1e-2), (5e4, 1.2e-3)]).marker(Marker::Cross).filled())
        .guide(&[(1e3, 1e-5), (1e4, 1e-6)])
        .legend(Legend::Ends);
    Picture::new(178.0, 60.0).titled(r"$\mu=0.45$", left).panel(right)
}

/// Two maps with a shared bar, regions, points and a curve.
pub fn maps() -> Picture {
    let panel = |shift: f64| {
        let cells = (0..30).flat_map(|j| (0..40).map(move |i| (f64::from(i) / 40.0, f64::from(j) / 30.0)));
        let values = cells.map(|(x, y)| x - y * y - shift).collect();
        Map::new(Axis::linear(r"$\tilde a_v$", 0.0, 1.0), Axis::linear(r"$\hat\Phi^{-1}$", 0.0, 1.0), 40, 30, values)
            .region("unstable", (0.8, 0.2))
            .region("stable", (0.3, 0.8))
            .point("b", (0.5, 0.5))
            .curve(line(20, |x| x))
    };
    Picture::new(120.0, 60.0).scale(ColorScale::diverging(r"$\tilde\Phi$", 0.2)).panel(panel(0.0)).panel(panel(0.2))
}

/// `count` walkers 1.5 apart with two waves that run against them, over `steps` time units, as a
/// field and as lines. The waves are small enough that nobody overtakes: 10 x wave < 1.5.
pub fn space_time(count: u32, steps: u32) -> Picture {
    let length = f64::from(count) * 1.5;
    let wave = 4.0 * std::f64::consts::PI / f64::from(count).max(100.0);
    let walk = |n: u32| {
        let time: Vec<f64> = (0..=steps).map(f64::from).collect();
        let phase = |t: f64| 0.05 * t + wave * f64::from(n);
        let position = time.iter().map(|t| 1.5 * f64::from(n) + 0.6 * t + 10.0 * math::sin(phase(*t))).collect();
        let speed = time.iter().map(|t| 0.6 + 0.5 * math::cos(phase(*t))).collect();
        Trajectory { time, position, speed }
    };
    let walks: Vec<Trajectory> = (0..count).map(walk).collect();
    let end = f64::from(steps);
    let whole = SpaceTime::new(Axis::linear("$t'$", 0.0, end), Axis::linear("$x'$", 0.0, length), length, &walks)
        .field()
        .outline([0.4 * end, 0.5 * end], [0.25 * length, 0.5 * length]);
    let time = Axis::linear("$t'$", 0.4 * end, 0.5 * end);
    let part = SpaceTime::new(time, Axis::linear("$x'$", 0.25 * length, 0.5 * length), length, &walks).line_width(0.2);
    let scale = ColorScale::sequential("speed $v'$", 0.0, 1.2);
    Picture::new(178.0, 70.0).column_shares(&[1.7, 1.0]).scale(scale).panel(whole).panel(part)
}

/// A sketch.
pub fn sketch() -> Picture {
    let drawing = Drawing::new()
        .arrow((2.0, 5.0), (50.0, 5.0), 0.8)
        .rectangle((10.0, 5.0), (20.0, 12.0), Some(Color(0xd2, 0xe2, 0xf4)))
        .dimension((10.0, 15.0), (40.0, 15.0))
        .dashed(&[(40.0, 3.0), (40.0, 17.0)])
        .circle((40.0, 8.0), 2.0, None)
        .dot((40.0, 5.0), 0.5)
        .label(r"$\dot x_{n+1}$", (25.0, 17.5));
    Picture::new(60.0, 22.0).panel(drawing)
}
