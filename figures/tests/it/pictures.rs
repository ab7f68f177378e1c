//! Pictures say what the scene says.

use std::path::Path;
use std::process::Command;

/// The SVG of figure 4 with this strength in its scene, from a made-up table of two straight lines.
fn figure_4(strength: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fig04-algebraic-std/scene.toml");
    let scene = std::fs::read_to_string(source).expect("the scene of figure 4");
    assert_eq!(scene.matches("mu = 0.45").count(), 1);
    let place = |name: &str| folder.path().join(name);
    std::fs::write(place("scene.toml"), scene.replace("mu = 0.45", &format!("mu = {strength}"))).expect("written");
    for table in ["stable.csv", "unstable.csv"] {
        std::fs::write(place(table), "t,std\n0,1e-6\n1,2e-6\n2,1e-6\n").expect("written");
    }
    let ended = Command::new(env!("CARGO_BIN_EXE_fig04-algebraic-std"))
        .args(["--draw-only", "--scene"])
        .arg(place("scene.toml"))
        .arg("--tables")
        .arg(folder.path())
        .arg("--pictures")
        .arg(folder.path())
        .output()
        .expect("the program runs");
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    std::fs::read_to_string(place("fig04.svg")).expect("a picture")
}

#[test]
fn a_panel_names_the_strength_of_its_scene() {
    let (old, same, new) = (figure_4("0.45"), figure_4("0.450"), figure_4("0.46"));
    assert!(old == same, "the same number, written otherwise");
    let differing: Vec<_> = old.lines().zip(new.lines()).filter(|(one, other)| one != other).collect();
    // one label, and in it nothing but the last digit
    let [(one, other)] = differing[..] else { panic!("{} lines differ", differing.len()) };
    let common = one.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    assert!(one.starts_with("<path fill=") && common > one.len() / 2, "{one}\n{other}");
}
