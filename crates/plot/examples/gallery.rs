//! One picture of each kind, from made-up data: `cargo run --release -p plot --example gallery -- FOLDER`.

use plot::style::{COLUMN_WIDTH, FULL_WIDTH};
use plot::{
    Axis, Color, ColorScale, Corner, Drawing, Legend, Lines, Map, Marker, Picture, PlotError, Point, Rendered, Series,
    SpaceTime, Trajectory,
};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: gallery FOLDER")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    type Maker = fn() -> Result<Rendered, PlotError>;
    let pictures: [(&str, Maker); 9] = [
        ("curves", curves),
        ("growth", growth),
        ("speeds", speeds),
        ("precision", precision),
        ("map", map),
        ("maps-row", maps_row),
        ("maps-square", maps_square),
        ("space-time", space_time),
        ("sketch", sketch),
    ];
    for (name, make) in pictures {
        let start = std::time::Instant::now();
        let files = make()?;
        let seconds = start.elapsed().as_secs_f64();
        println!("{name}: {:.2} s, PNG {} bytes, SVG {} bytes", seconds, files.png.len(), files.svg.len());
        std::fs::write(folder.join(format!("{name}.png")), &files.png)?;
        std::fs::write(folder.join(format!("{name}.svg")), &files.svg)?;
    }
    Ok(())
}

fn sampled(from: f64, to: f64, count: u32, value: impl Fn(f64) -> f64) -> Vec<Point> {
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(count);
    (0..=count).map(|i| (at(i), value(at(i)))).collect()
}

/// A kink and its smooth approximations.
fn curves() -> Result<Rendered, PlotError> {
    let smooth = |width: f64| sampled(-1.0, 1.0, 400, move |x| width * math::ln(1.0 + math::exp(-x / width)));
    let panel = Lines::new(Axis::linear("$x$", -1.0, 1.0), Axis::linear(r"$r_\varepsilon(x)$", 0.0, 1.0))
        .series(Series::line("$r(x)$", vec![(-1.0, 1.0), (0.0, 0.0), (1.0, 0.0)]).look(2).solid().thick(1.8))
        .series(Series::line(r"$\varepsilon=0.1$", smooth(0.1)).look(0).solid())
        .series(Series::line(r"$\varepsilon=0.3$", smooth(0.3)).look(1))
        .series(Series::line(r"$\varepsilon=0.5$", smooth(0.5)).look(3));
    Picture::new(COLUMN_WIDTH, 62.0).panel(panel).render()
}

/// Decay and growth, with a logarithmic inset and published points.
fn growth() -> Result<Rendered, PlotError> {
    let decay = |t: f64| 0.012 * math::exp(-t / 160.0) * (1.0 + 0.3 * math::sin(t / 20.0));
    let rise = |t: f64| 0.012 * math::exp(t / 500.0);
    let published = |f: &dyn Fn(f64) -> f64| sampled(0.0, 3000.0, 12, f);
    let y = || Axis::linear("$\\mathrm{std}(v')$", 0.0, 0.02);
    let inset = Lines::new(Axis::linear("$t'$", 0.0, 3000.0).steps(3), Axis::log10("", 1e-12, 1.0))
        .series(Series::line("", sampled(0.0, 3000.0, 600, decay)));
    let left = Lines::new(Axis::linear("$t'$", 0.0, 3000.0), y())
        .series(Series::line("this work", sampled(0.0, 3000.0, 3000, decay)))
        .series(Series::points("published", Marker::Circle, published(&decay)).look(2))
        .legend(Legend::Corner(Corner::BottomRight))
        .inset([0.36, 0.3, 0.98, 0.97], inset);
    let right = Lines::new(Axis::linear("$t'$", 0.0, 300.0), y())
        .series(Series::line("this work", sampled(0.0, 300.0, 300, rise)))
        .series(Series::points("published", Marker::Circle, sampled(0.0, 300.0, 12, rise)).look(2))
        .legend(Legend::Corner(Corner::TopLeft))
        .vertical(250.0)
        .note("overlap", (252.0, 0.002));
    Picture::new(FULL_WIDTH, 64.0).titled(r"stable: $\mu=0.45$", left).titled(r"unstable: $\mu=0.55$", right).render()
}

/// Speeds over indices at two times.
fn speeds() -> Result<Rendered, PlotError> {
    let at =
        |phase: f64| sampled(0.0, 132.0, 132, move |n| 0.5 + 0.5 * math::sin((n + phase) / 9.0) * math::sin(n / 30.0));
    let panel = |phase: f64| {
        let axes = (Axis::linear("$n$", 0.0, 132.0), Axis::linear("$v_n$ (m/s)", -0.2, 1.2).steps(7));
        Lines::new(axes.0, axes.1)
            .series(Series::line("", at(phase)).marker(Marker::Circle).filled().marker_size(0.6))
            .horizontal(0.0)
    };
    Picture::new(FULL_WIDTH, 60.0).titled("$t=300$ s", panel(0.0)).titled("$t=2000$ s", panel(30.0)).render()
}

/// Error against cost, both logarithmic.
fn precision() -> Result<Rendered, PlotError> {
    let methods =
        [("Euler", 1.0), ("Heun", 2.0), ("RK4", 4.0), ("Dormand-Prince 5", 5.0), ("DOP853", 8.0), ("Verner 9(8)", 9.0)];
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Plus, Marker::Cross];
    let mut panel = Lines::new(
        Axis::log10("right-hand sides", 1e3, 1e6),
        Axis::log10(r"error $\Vert x-\hat x\Vert_\infty$", 1e-14, 1.0),
    )
    .legend(Legend::Ends)
    .guide(&[(2e4, 3e-2), (4e5, 1.5e-3)])
    .note("slope $-1$", (7e4, 1.6e-2));
    for (index, (name, order)) in methods.into_iter().enumerate() {
        let cost = |level: i32| 1e3 * math::pow(2.0, f64::from(level)) * (1.0 + order / 3.0);
        let error = |n: f64| f64::max(math::pow(n / 900.0, -order) * 0.2 * order, 2e-14 * (1.0 + order));
        let points = (0..9).map(|level| (cost(level), error(cost(level)))).collect();
        panel = panel.series(Series::line(name, points).marker(markers[index]));
    }
    Picture::new(FULL_WIDTH * 0.7, 80.0).panel(panel).render()
}

fn matrix(x: (f64, f64), y: (f64, f64), value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let centre = |range: (f64, f64), i: u32| range.0 + (range.1 - range.0) * (f64::from(i) + 0.5) / 200.0;
    let cells = (0..200).flat_map(|j| (0..200).map(move |i| (i, j)));
    cells.map(|(i, j)| value(centre(x, i), centre(y, j))).collect()
}

/// One map with an exact curve, region names and marked points.
fn map() -> Result<Rendered, PlotError> {
    let value = |a: f64, v: f64| 0.1 * (v - 1.2 - 2.0 * a * a) * (1.0 + 0.5 * a);
    let panel = Map::new(
        Axis::linear(r"$\tilde a_v$", 0.0, 1.0),
        Axis::linear("$v_0'$", 0.0, 4.0),
        200,
        200,
        matrix((0.0, 1.0), (0.0, 4.0), value),
    )
    .curve(sampled(0.0, 1.0, 100, |a| 1.3 + 2.0 * a * a))
    .region("unstable", (0.3, 3.2))
    .region("stable", (0.6, 0.8))
    .point("Fig. 11", (0.1, 2.2));
    Picture::new(COLUMN_WIDTH, 70.0).scale(ColorScale::diverging(r"$\hat\Phi$", 0.12)).panel(panel).render()
}

/// Three maps that share one bar.
fn maps_row() -> Result<Rendered, PlotError> {
    let panel = |shift: f64| {
        let value =
            move |mu: f64, d: f64| 0.9 * (mu - 0.35 - shift * d) - 0.3 * mu * mu * d + 0.05 * math::sin(3.0 * d);
        Map::new(
            Axis::linear(r"$\mu$", 0.0, 1.0),
            Axis::linear("$d'$", 0.0, 3.0),
            200,
            200,
            matrix((0.0, 1.0), (0.0, 3.0), value),
        )
        .region("stable", (0.2, 2.4))
        .region("unstable", (0.8, 0.4))
    };
    Picture::new(FULL_WIDTH, 60.0)
        .scale(ColorScale::diverging(r"$\Phi$", 0.5))
        .titled(r"$\langle\mu,0,2,0\rangle$", panel(0.0))
        .titled(r"$\langle\mu,1,2,0\rangle$", panel(0.1))
        .titled(r"$\langle\mu,0,2,0.2\rangle$", panel(-0.05))
        .render()
}

/// Four maps in a square.
fn maps_square() -> Result<Rendered, PlotError> {
    let pi = std::f64::consts::PI;
    let panel = |shift: f64| {
        let value =
            move |d: f64, k: f64| (0.2 - shift * d) * (1.0 - math::cos(k)) * math::sin(2.0 * d + k * shift) - 0.02;
        let k = Axis::linear("$k$", 0.0, pi).ticks(&[(0.0, "0"), (pi / 2.0, r"$\pi/2$"), (pi, r"$\pi$")]);
        Map::new(Axis::linear("$d'$", 0.0, 4.0), k, 200, 200, matrix((0.0, 4.0), (0.0, pi), value))
            .region("unstable", (0.6, 2.2))
            .region("stable", (2.3, 1.5))
    };
    Picture::new(FULL_WIDTH, 130.0)
        .columns(2)
        .scale(ColorScale::diverging(r"$\mathrm{Re}\,z^+$", 0.2))
        .titled(r"$\langle 0.5,0,2,0\rangle$", panel(0.0))
        .titled(r"$\langle 0.5,1,2,0\rangle$", panel(0.02))
        .titled(r"$\langle 0.5,0,2,0.5\rangle$", panel(0.03))
        .titled(r"$\langle 0.5,1,2,0.5\rangle$", panel(0.05))
        .render()
}

/// Stop-and-go waves of a car-following model on a ring, whole and enlarged.
fn space_time() -> Result<Rendered, PlotError> {
    let walks = car_following(133, 200.0, 3000);
    let speed = ColorScale::sequential("speed $v'$", 0.0, 1.2);
    let whole = SpaceTime::new(Axis::linear("$t'$", 0.0, 3000.0), Axis::linear("$x'$", 0.0, 200.0), 200.0, &walks)
        .field()
        .outline([2000.0, 2200.0], [50.0, 100.0]);
    let part =
        SpaceTime::new(Axis::linear("$t'$", 2000.0, 2200.0).steps(4), Axis::linear("$x'$", 50.0, 100.0), 200.0, &walks)
            .line_width(0.25);
    Picture::new(FULL_WIDTH, 75.0).column_shares(&[1.7, 1.0]).scale(speed).panel(whole).panel(part).render()
}

fn car_following(count: usize, length: f64, steps: usize) -> Vec<Trajectory> {
    let gap = length / count as f64;
    let tanh = |x: f64| 1.0 - 2.0 / (math::exp(2.0 * x) + 1.0);
    let wanted = |space: f64| 0.6 * (tanh(3.0 * (space - gap)) + tanh(3.0 * gap - 1.5));
    let mut x: Vec<f64> = (0..count).map(|n| n as f64 * gap).collect();
    let mut v = vec![wanted(gap); count];
    x[0] += 0.1;
    let mut walks = vec![Trajectory::default(); count];
    for step in 0..=steps {
        for (n, walk) in walks.iter_mut().enumerate() {
            walk.time.push(step as f64);
            walk.position.push(x[n]);
            walk.speed.push(v[n]);
        }
        for _ in 0..20 {
            let space: Vec<f64> =
                (0..count).map(|n| if n + 1 < count { x[n + 1] - x[n] } else { x[0] + length - x[n] }).collect();
            for n in 0..count {
                v[n] += 0.05 * 2.0 * (wanted(space[n]) - v[n]);
                x[n] += 0.05 * v[n];
            }
        }
    }
    walks
}

/// Two boxes on a line with their lengths.
fn sketch() -> Result<Rendered, PlotError> {
    let fill = Some(Color(0xd2, 0xe2, 0xf4));
    let drawing = Drawing::new()
        .arrow((2.0, 10.0), (82.0, 10.0), 0.8)
        .rectangle((10.0, 10.0), (24.0, 18.0), fill)
        .rectangle((52.0, 10.0), (68.0, 18.0), fill)
        .dashed(&[(17.0, 5.0), (17.0, 24.0)])
        .dashed(&[(60.0, 5.0), (60.0, 24.0)])
        .dimension((17.0, 23.0), (60.0, 23.0))
        .label(r"$\Delta x_n$", (38.5, 25.5))
        .dimension((24.0, 14.0), (52.0, 14.0))
        .label("$d_n$", (38.0, 16.0))
        .arrow((20.0, 20.0), (29.0, 20.0), 1.0)
        .note(r"$\dot x_n$", (30.0, 20.0))
        .dot((17.0, 10.0), 0.6)
        .dot((60.0, 10.0), 0.6)
        .label("$x_n$", (17.0, 3.0))
        .label("$x_{n+1}$", (60.0, 3.0))
        .label("$x$", (80.0, 7.0));
    Picture::new(COLUMN_WIDTH, 30.0).panel(drawing).render()
}
