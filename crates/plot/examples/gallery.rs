//! The house style on one page: each kind of panel, drawn from made-up data, with the code that draws it. `cargo run
//! --release -p plot --example gallery` writes `crates/plot/gallery.html`, or the file named on the command line.

use plot::style::{COLUMN_WIDTH, FULL_WIDTH};
use plot::{
    Axis, Color, ColorScale, Corner, Drawing, Fill, Key, Lines, Map, Marker, Picture, Plane, PlotError, Point, Series,
    SpaceTime, Trajectory,
};
use std::fmt::Write as _;

/// A kind of panel: name of the function here, what it shows, and the function.
pub type Kind = (&'static str, &'static str, fn() -> Picture);

/// The kinds of panels.
pub const KINDS: [Kind; 7] = [
    ("curves", "Curves with a legend; every series has its own colour, lightness and dashes.", curves),
    ("inset", "A logarithmic inset, points of another source, guides and notes.", inset),
    ("work", "Error against work: two logarithmic axes, markers, a slope to compare with.", work),
    ("maps", "Signed values over two parameters: zero line, names of regions, one bar for all panels.", maps),
    ("space_time", "Trajectories on a ring coloured by speed: as a field, and enlarged as lines.", space_time),
    ("sketch", "A sketch from lines, arrows, dimensions, boxes, discs and labels.", sketch),
    ("planes", "Classes of cells over two parameters, with exact lines on top; one key for all panels.", planes),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let usual = concat!(env!("CARGO_MANIFEST_DIR"), "/gallery.html").to_owned();
    Ok(std::fs::write(std::env::args().nth(1).unwrap_or(usual), page()?)?)
}

/// The page.
///
/// # Errors
/// A picture that cannot be drawn.
pub fn page() -> Result<String, PlotError> {
    let mut page = HEAD.to_owned();
    for (name, words, picture) in KINDS {
        let svg = String::from_utf8_lossy(&picture().render()?.svg).into_owned();
        // writing to a String cannot fail
        let _ = write!(page, "<h2>{words}</h2>\n{svg}<pre>{}</pre>\n", escaped(source(name)));
    }
    Ok(page + "</html>\n")
}

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>House style of the pictures</title>
<style>
body { font: 16px/1.4 serif; max-width: 60em; margin: 2em auto; padding: 0 1em }
h2 { font-size: 1.1em; margin-top: 2.5em }
svg { zoom: 1.5; max-width: 100%; height: auto }
pre { font-size: 12px; overflow-x: auto; background: #f4f4f4; padding: 1em }
</style>
<h1>House style of the pictures</h1>
<p>Text of 7 to 9 pt and lines of 0.5 to 1 pt at the printed size, one column (86 mm) or the page (178 mm) wide. Colours
differ in a grey print and to colour-blind readers. Made by <code>cargo run --release -p plot --example gallery</code>.</p>
";

/// The text of a function of this file.
fn source(name: &str) -> &'static str {
    let all = include_str!("gallery.rs");
    let start = all.find(&format!("\nfn {name}()")).map_or(0, |place| place + 1);
    let length = all[start..].find("\n}\n").map_or(0, |end| end + 2);
    &all[start..start + length]
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn sampled(from: f64, to: f64, count: u32, value: impl Fn(f64) -> f64) -> Vec<Point> {
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(count);
    (0..=count).map(|i| (at(i), value(at(i)))).collect()
}

fn curves() -> Picture {
    let wave = |phase: f64| sampled(0.0, 10.0, 200, move |x| math::sin(x - phase) * math::exp(-x / 8.0));
    let mut panel = Lines::new(Axis::linear("$t'$", 0.0, 10.0), Axis::linear(r"$\Delta x'_n$", -1.0, 1.5))
        .legend(Corner::TopRight)
        .horizontal(0.0);
    for phase in [0.0, 0.5, 1.0, 1.5, 2.0] {
        panel = panel.series(Series::line(&format!(r"$\varphi={phase}$"), wave(phase)));
    }
    Picture::new(COLUMN_WIDTH, 62.0).panel(panel)
}

fn inset() -> Picture {
    let growth = |t: f64| 1e-6 * math::exp(t / 75.0);
    let curve = sampled(0.0, 900.0, 300, growth);
    let inset = Lines::new(Axis::linear("", 0.0, 900.0).steps(3), Axis::log10("", 1e-6, 1.0))
        .series(Series::line("", curve.clone()));
    let panel = Lines::new(Axis::linear("$t$", 0.0, 900.0), Axis::from_zero(r"$\mathrm{std}(v')$", [growth(900.0)]))
        .series(Series::points("published", Marker::Circle, sampled(0.0, 900.0, 30, growth)).look(2))
        .series(Series::line("regenerated", curve).look(0))
        .legend(Corner::BottomLeft)
        .vertical(800.0)
        .note("end", (810.0, 0.01))
        .inset([0.03, 0.35, 0.75, 0.97], inset);
    Picture::new(COLUMN_WIDTH, 62.0).titled(r"$\mu=0.55$", panel)
}

fn work() -> Picture {
    let methods = [("Heun", 2, Marker::Circle), ("RK4", 4, Marker::Square), ("DOP853", 8, Marker::Triangle)];
    let mut panel = Lines::new(
        Axis::log10("right-hand sides", 1e3, 1e6),
        Axis::log10(r"error $\Vert x-\hat x\Vert_\infty$", 1e-15, 1.0),
    )
    .legend(Corner::BottomLeft)
    .guide(&[(2e4, 3e-2), (4e5, 7.5e-5)])
    .note("slope $-2$", (1e5, 5e-3));
    for (name, order, marker) in methods {
        let error = |n: f64| math::pow(n / 800.0, -f64::from(order));
        let points = (1..9).map(|level| 1e3 * f64::from(1 << level)).map(|n| (n, error(n))).collect();
        panel = panel.series(Series::line(name, points).marker(marker));
    }
    Picture::new(COLUMN_WIDTH, 70.0).panel(panel)
}

fn maps() -> Picture {
    let value = |shift: f64, x: f64, y: f64| x - y * y - shift + 0.05 * math::sin(12.0 * y);
    let cell = |i: usize| ((i % 80) as f64 / 80.0, (i / 80) as f64 / 60.0);
    let values = |shift: f64| (0..80 * 60).map(|i| value(shift, cell(i).0, cell(i).1)).collect::<Vec<f64>>();
    let panel = |shift: f64| {
        let axes = (Axis::linear(r"$\tilde a_v$", 0.0, 1.0), Axis::linear("$d'$", 0.0, 1.0));
        Map::new(axes.0, axes.1, 80, 60, values(shift)).names("stable", "unstable")
    };
    Picture::new(FULL_WIDTH, 60.0)
        .scale(ColorScale::diverging(r"$\tilde\Phi$", values(0.1)))
        .titled(r"$\langle 0, 2\rangle$", panel(0.0))
        .titled(r"$\langle 1, 2\rangle$", panel(0.2))
}

fn planes() -> Picture {
    let classes = [
        (Fill::PALE, "decays"),
        (Fill::BLUE, "waves"),
        (Fill::PURPLE, "waves, backwards"),
        (Fill::ORANGE, "contact"),
        (Fill::BLACK, "blow-up"),
        (Fill::GREY, "undecided"),
        (Fill::RISING, "closed at the start"),
    ];
    let margin = |x: f64, y: f64| x - y * y - 0.1;
    let class = |x: f64, y: f64| match margin(x, y) {
        _ if x > 0.85 && y < 0.3 => 6,
        margin if margin < 0.0 => 0,
        margin if margin > 0.45 => {
            if y > 0.45 {
                5
            } else {
                4
            }
        }
        margin => ((6.0 * margin) as usize).min(2) + 1,
    };
    let cells = |i: usize| class((i % 50) as f64 / 50.0 + 0.01, (i / 50) as f64 / 40.0 + 0.0125);
    let points = |value: &dyn Fn(f64, f64) -> f64| {
        (0..60 * 60).map(|i| value((i % 60) as f64 / 59.0, (i / 60) as f64 / 59.0)).collect::<Vec<f64>>()
    };
    let panel = |x: Axis| {
        let plane = Plane::new(x, Axis::linear("$v_0'$", 0.0, 1.0), 50, 40, (0..2000).map(cells).collect());
        let plane = classes.into_iter().fold(plane, |plane, (fill, name)| plane.class(fill, name));
        plane.border(60, 60, points(&|x, y| y + 0.3 - 0.6 * x)).contour(60, 60, points(&margin))
    };
    let key = classes.into_iter().fold(Key::new(), |key, (fill, name)| key.fill(fill, name));
    Picture::new(FULL_WIDTH, 75.0)
        .key(key.contour("exact criterion").border("uniform flow walks backwards (teeth)"))
        .titled("linear", panel(Axis::linear(r"$\tilde a_v$", 0.0, 1.0)))
        .titled("logarithmic", panel(Axis::log10(r"$\epsilon_1$", 1e-4, 1.0)))
}

fn space_time() -> Picture {
    let (count, length, end) = (60, 90.0, 300.0);
    // two waves run against the walkers, small enough that nobody overtakes
    let walk = |n: u32| {
        let phase = |t: f64| 0.05 * t + 4.0 * std::f64::consts::PI / f64::from(count) * f64::from(n);
        let position = |t: f64| 1.5 * f64::from(n) + 0.6 * t + 6.0 * math::sin(phase(t));
        (0..=300).map(f64::from).map(|t| [t, position(t), 0.6 + 0.3 * math::cos(phase(t))]).collect()
    };
    let walks: Vec<Trajectory> = (0..count).map(walk).collect();
    let whole = SpaceTime::new(Axis::linear("$t'$", 0.0, end), Axis::linear("$x'$", 0.0, length), length, &walks)
        .field()
        .every(10)
        .outline([150.0, 200.0], [0.0, 30.0]);
    let part = SpaceTime::new(Axis::linear("$t'$", 150.0, 200.0), Axis::linear("$x'$", 0.0, 30.0), length, &walks)
        .line_width(0.2);
    let speeds = walks.iter().flatten().map(|sample| sample[2]);
    Picture::new(FULL_WIDTH, 70.0)
        .scale(ColorScale::sequential("speed $v'$", speeds))
        .titled("all", whole)
        .titled("the window", part)
}

fn sketch() -> Picture {
    let drawing = Drawing::new()
        .arrow((2.0, 5.0), (78.0, 5.0), 0.8)
        .rectangle((10.0, 5.0), (30.0, 13.0), Color(0xd2, 0xe2, 0xf4))
        .dimension((20.0, 17.0), (60.0, 17.0))
        .dashed((20.0, 3.0), (20.0, 19.0))
        .dashed((60.0, 3.0), (60.0, 19.0))
        .dot((20.0, 9.0), 0.6)
        .label(r"$\Delta x_{n+1}$", (40.0, 20.0))
        .label("$x$", (81.0, 5.0));
    Picture::new(COLUMN_WIDTH, 24.0).panel(drawing)
}
