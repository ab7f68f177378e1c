//! Scene files: their panels, and what distinguishes two scenes.

use files::scene_file::{Kind, SceneFile, parse};

fn scene_file(text: &str) -> SceneFile {
    parse("my.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

const TEXT: &str = "title = \"A run\"\nsource = \"fig1\"\n[law]\nkind = \"algebraic\"\nq = 2\nmu = 0.5\n\
                    [run]\nt_end = 10\n[panel.left.law]\nmu = 0.25\n[panel.right]\nlaw = { q = 1.0 }\nrun.t_end = 20\n\
                    [origin]\n\"law.q\" = \"eq1\"\n";

#[test]
fn panels_lie_on_top_of_the_file() {
    let scene_file = scene_file(TEXT);
    assert_eq!((scene_file.title.as_str(), scene_file.source.as_str()), ("A run", "fig1"));
    assert_eq!(scene_file.origin, [("law.q".to_owned(), "eq1".to_owned())]);
    let names: Vec<&str> = scene_file.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(names, ["left", "right"]);
    let determinants = |name: &str| scene_file.panel(name).expect("the panel").determinants();
    assert_eq!(determinants("left"), "law.kind = \"algebraic\"\nlaw.mu = 0.25\nlaw.q = 2.0\nrun.t_end = 10.0");
    assert_eq!(determinants("right"), "law.kind = \"algebraic\"\nlaw.mu = 0.5\nlaw.q = 1.0\nrun.t_end = 20.0");
    let error = scene_file.panel("middle").expect_err("there is none");
    assert_eq!(error.to_string(), "my.toml: no panel middle; the scene has left, right");
}

#[test]
fn a_file_without_panels_has_one() {
    let scene_file = scene_file("[law]\nq = 2\n");
    assert_eq!(scene_file.panels.len(), 1);
    assert_eq!((scene_file.panels[0].name.as_str(), scene_file.panels[0].kind), ("main", Kind::Drawing));
    assert!(scene_file.title.is_empty() && scene_file.source.is_empty() && scene_file.origin.is_empty());
}

#[test]
fn kinds_follow_from_the_tables() {
    let cases = [("[run]\n", Kind::Run), ("[map]\n", Kind::Map), ("[curve]\n", Kind::Curve), ("", Kind::Drawing)];
    for (text, kind) in cases {
        assert_eq!(scene_file(text).panels[0].kind, kind);
    }
    let two = scene_file("[law]\nq = 1\n[panel.a.run]\nt_end = 1\n[panel.b.map]\nvalue = \"criterion\"\n");
    assert_eq!([two.panels[0].kind, two.panels[1].kind], [Kind::Run, Kind::Map]);
}

#[test]
fn only_values_determine_a_scene() {
    let plain =
        scene_file("[law]\nq = 1\nmu = 0.5\nkind = \"algebraic\"\n[run]\nt_end = 1e3\n").panels[0].determinants();
    let same = [
        // comments, order, spelling of numbers, title, source and origin
        "# a comment\n[run] # another\nt_end = 1000\n[law]\nkind = 'algebraic'\nmu = 5e-1\nq = 1.0\n",
        "title = \"T\"\nsource = \"S\"\nlaw = { mu = 0.50, q = 1, kind = \"algebraic\" }\nrun.t_end = 1_000.0\n",
        "[law]\nq = 1\nmu = 0.5\nkind = \"algebraic\"\n[run]\nt_end = 1e3\n[origin]\n\"law.q\" = \"x\"\n",
        "[law]\r\nq = 1\r\nmu = 0.5\r\nkind = \"algebraic\"\r\n[run]\r\nt_end = 1e3\r\n",
    ];
    for text in same {
        assert_eq!(scene_file(text).panels[0].determinants(), plain, "{text}");
    }
    let other = [
        "[law]\nq = 1\nmu = 0.5000000000000001\nkind = \"algebraic\"\n[run]\nt_end = 1e3\n",
        "[law]\nq = 1\nmu = 0.5\nkind = \"algebraic\"\ndelta = 0\n[run]\nt_end = 1e3\n",
        "[law]\nq = \"1\"\nmu = 0.5\nkind = \"algebraic\"\n[run]\nt_end = 1e3\n",
    ];
    for text in other {
        assert_ne!(scene_file(text).panels[0].determinants(), plain, "{text}");
    }
}

#[test]
fn values_cannot_pass_for_others() {
    // a text with a line break or an equals sign is quoted, so two scenes never share a text
    let one = scene_file("[law]\na = \"1\\nlaw.b = 2.0\"\n").panels[0].determinants();
    let two = scene_file("[law]\na = 1\nb = 2\n").panels[0].determinants();
    assert_ne!(one, two);
    assert_eq!(one.lines().count(), 1);
}

#[test]
fn scenes_in_other_encodings_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("scene.toml");
    let utf16: Vec<u8> = "\u{feff}title = 'x'".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, line, words) in
        [(utf16, 0, "UTF-16"), (b"title = 'x'\nsource = 'K\xf6ln'\n".to_vec(), 2, "byte 0xf6 is not UTF-8")]
    {
        std::fs::write(&file, bytes).expect("a file");
        let error = files::scene_file::read(&file).unwrap_err();
        assert_eq!((error.line, error.problem.contains(words)), (line, true), "{error}");
        assert_eq!(error.file, file.display().to_string());
    }
    std::fs::write(&file, "\u{feff}title = 'x'\n").expect("a file");
    assert_eq!(files::scene_file::read(&file).expect("a scene").title, "x");
    let error = files::scene_file::read(folder.path()).unwrap_err();
    assert!(error.problem.contains("is a folder"), "{error}");
}

#[test]
fn tables_that_a_figure_reads_are_names_below_data() {
    let read = |names: &str| {
        files::scene_file::parse("own.toml", &format!("title = \"\"\nreads = \"{names}\"\n")).map(|scene| scene.reads)
    };
    assert_eq!(read("outcomes/plain  timing/scale").expect("names"), ["outcomes/plain", "timing/scale"]);
    for (names, bad) in [("a/b ../c", "../c"), ("/etc/hosts", "/etc/hosts"), ("a/./b", "a/./b")] {
        let told = read(names).expect_err("a bad name").to_string();
        assert!(told.contains("own.toml:2") && told.contains(bad), "{told}");
    }
}
