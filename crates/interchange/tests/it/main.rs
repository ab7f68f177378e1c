//! Tests of exported files: their bytes, their tables, and the input that is refused.

mod program;
mod sqlite;
mod text;

use files::scene_file;
use interchange::header::Header;

/// A ring of two pedestrians; its title tries to mislead a reader of comments.
pub const SCENE: &str = "
title = 'two # x/cm\n framerate: 99'
source = 'fig:jams'
[law]
kind = 'logarithmic'
v0 = 3.0
epsilon = 0.01
[ring]
pedestrians = 2
length = 10.0
[start]
shift = 0.1
[run]
t_end = 0.5
sample = 0.25
method = 'taylor'
tolerance = 1e-9
";

/// Two frames of it, 8 a second with tau = 0.5 s.
pub const TABLE: &str = "t,n,x,v\n0,0,-0.125,0\n0,1,5,0\n0.25,0,0.3,0.1\n0.25,1,5.1,0.2\n";

/// What its files say of themselves, with this `a_0`.
pub fn header(a_0: Option<f64>) -> Header {
    let scene_file = scene_file::parse("two.toml", &scene()).expect("a scene");
    Header::new(&scene_file, scene_file.panel("main").expect("a panel"), a_0, 0.5, 8.0).expect("a header")
}

/// The scene with an escape that TOML understands.
pub fn scene() -> String {
    SCENE.replace("'two # x/cm\n framerate: 99'", "\"two # x/cm\\n framerate: 99\"")
}
