//! Shards: they can be computed anywhere, and foreign ones are refused.

use super::*;

#[test]
fn a_shard_is_the_same_wherever_and_however_often_it_is_computed() {
    let place = SceneFolder::new(&small());
    for out in ["here", "there"] {
        place.succeed(out, &["--shard", "1/2"]);
    }
    let shard = place.read("here/shards/1-of-2.csv");
    assert_eq!(shard, place.read("there/shards/1-of-2.csv"));
    let before = std::fs::metadata(place.path("here/shards/1-of-2.csv")).and_then(|data| data.modified());
    let said = place.succeed("here", &["--shard", "1/2", "--json"]);
    let after = std::fs::metadata(place.path("here/shards/1-of-2.csv")).and_then(|data| data.modified());
    assert_eq!((before.expect("a date"), &shard), (after.expect("a date"), &place.read("here/shards/1-of-2.csv")));
    let said: Value = serde_json::from_str(&said).expect("JSON");
    let run = shard.lines().skip(2).filter(|line| !line.contains(",neighbours,")).count();
    assert_eq!((&said["shard"], &said["of"], &said["cells"]), (&1.into(), &2.into(), &run.into()), "{said}");
    // both at once into one folder: whoever ends last has written the same
    let mut children: Vec<_> =
        (0..2).map(|_| place.command("both", &["--shard", "1/2"]).spawn().expect("it starts")).collect();
    let codes: Vec<_> = children.iter_mut().map(|child| child.wait().expect("it ends").code()).collect();
    assert_eq!(codes, [Some(0); 2]);
    assert!(place.read("both/shards/1-of-2.csv") == shard);
    assert!(!place.path("both/shards/1-of-2.part").exists());
}

#[test]
fn a_damaged_shard_is_named_with_its_line() {
    let place = SceneFolder::new(&small());
    place.succeed("out", &["--shard", "1/1"]);
    let shard = "out/shards/1-of-1.csv";
    let sound = place.read(shard);
    let lines: Vec<&str> = sound.lines().collect();
    let with = |at: usize, line: &str| {
        let mut lines = lines.clone();
        lines[at] = line;
        lines.join("\n") + "\n"
    };
    let flipped = lines[7].replacen(',', ";", 1);
    let outside = format!("99,{}", lines[9].split_once(',').expect("indices").1);
    let doubled = lines[9];
    // the last digit of a number within a tile, which is as good a number
    let row = lines.iter().skip(2).position(|line| line.contains(",run,")).expect("a cell that was run") + 2;
    let (numbers, sum) = lines[row].rsplit_once(',').expect("a sum");
    let digit = numbers.chars().next_back().filter(char::is_ascii_digit).expect("an error");
    let other = if digit == '1' { '2' } else { '1' };
    let changed = format!("{}{other},{sum}", &numbers[..numbers.len() - 1]);
    let place_of_digit = format!("1-of-1.csv:{}: ", row + 1);
    let cases = [
        (with(row, &changed), place_of_digit.as_str()),
        (with(7, &flipped), "1-of-1.csv:8: "),
        (with(4, "1,2,nonsense,0,run,,,,,,"), "1-of-1.csv:5: "),
        (with(10, &lines[10].replace(",0,", ",7,")), "1-of-1.csv:11: "),
        (with(1, "i,j,outcome"), "1-of-1.csv:2: "),
        (with(9, &outside), "1-of-1.csv:10: "),
        (with(10, doubled), "1-of-1.csv:11: "),
        // the last line but its end, and the last line whole
        (sound[..sound.len() - 1].to_owned(), "1-of-1.csv"),
        (lines[..lines.len() - 1].join("\n") + "\n", "1-of-1.csv"),
        (String::new(), "1-of-1.csv:1: "),
        (lines[0][..20].to_owned(), "1-of-1.csv:1: "),
    ];
    for (damaged, told) in cases {
        place.write(shard, &damaged);
        place.fail("out", &["--gather"], 2, &[told]);
        assert!(!place.has_results("out"), "{told}");
        // computing it again does not take it for whole either, and leaves it for its owner to look at
        place.fail("out", &["--shard", "1/1"], 2, &["1-of-1.csv"]);
        assert_eq!(place.read(shard), damaged);
    }
    let mut bytes = sound.clone().into_bytes();
    let at = sound.len() / 2;
    bytes[at] = 0xff;
    std::fs::write(place.path(shard), bytes).expect("a file");
    place.fail("out", &["--gather"], 2, &["1-of-1.csv:"]);
    place.write(shard, &sound);
    place.succeed("out", &["--gather"]);
}

#[test]
fn missing_shards_are_named() {
    let place = SceneFolder::new(&small());
    place.fail("out", &["--gather"], 3, &["out", "no shard"]);
    place.succeed("out", &["--shard", "2/4"]);
    place.fail("out", &["--gather"], 3, &["1/4, 3/4, 4/4", "--shard"]);
    place.kill("out", &["--shard", "3/4", "--jobs", "1"], "out/shards/3-of-4.part", 5);
    place.fail("out", &["--gather"], 3, &["1/4, 3/4, 4/4"]);
    assert!(!place.has_results("out"));
    for shard in ["4/4", "3/4", "1/4"] {
        place.succeed("out", &["--shard", shard]);
    }
    place.succeed("out", &["--gather"]);
    place.succeed("whole", &[]);
    assert_eq!(place.results("out"), place.results("whole"));
}

#[test]
fn shards_of_another_scene_program_or_split_are_refused() {
    let place = SceneFolder::new(&small());
    place.succeed("out", &["--shard", "1/2"]);
    let scene = place.read("scene.toml");
    let other = replace(&scene, "shift = 0.1", "shift = 0.2");
    // another scene
    place.write("scene.toml", &other);
    place.fail("out", &["--shard", "1/2"], 2, &["1-of-2.csv:1: ", "another scene"]);
    place.succeed("out", &["--shard", "2/2"]);
    place.fail("out", &["--gather"], 2, &["1-of-2.csv:1: ", "another scene"]);
    place.write("scene.toml", &scene);
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "another scene"]);
    // another program
    std::fs::remove_file(place.path("out/shards/2-of-2.csv")).expect("a shard");
    place.succeed("out", &["--shard", "2/2", "--program=another"]);
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "program"]);
    // a foreign shard before one that is missing: it says more
    std::fs::remove_file(place.path("out/shards/1-of-2.csv")).expect("a shard");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: "]);
    // several splits
    std::fs::remove_file(place.path("out/shards/2-of-2.csv")).expect("a shard");
    for shard in ["1/2", "2/2", "1/3"] {
        place.succeed("out", &["--shard", shard]);
    }
    place.fail("out", &["--gather"], 2, &["several splits", "2", "3"]);
    // a shard under the name of another, and what is none
    std::fs::rename(place.path("out/shards/1-of-3.csv"), place.path("out/shards/2-of-2.csv")).expect("a shard");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "shard 2 of 2"]);
    place.write("out/shards/2-of-2.csv", "a,b\n1,2\n");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "not a shard"]);
    place.write("out/shards/notes.csv", "");
    place.fail("out", &["--gather"], 2, &["notes.csv", "I-of-N.csv"]);
    assert!(!place.has_results("out"));
    // words, colours and spaces of a scene do not count
    for name in ["notes.csv", "2-of-2.csv"] {
        std::fs::remove_file(place.path("out/shards").join(name)).expect("a file");
    }
    place.write("scene.toml", &format!("# the same\n{}", replace(&scene, "shift = 0.1", "shift  =  1e-1")));
    place.succeed("out", &["--shard", "2/2"]);
    place.succeed("out", &["--gather"]);
}

#[test]
fn shards_beyond_the_split_are_refused() {
    let place = SceneFolder::new(&small());
    for shard in ["0/3", "3/2", "1/0", "-1/3", "1", "a/b", "1/3/5", "1.5/3", "", "1/1000001"] {
        let ended = place.sweep("out", &[&format!("--shard={shard}")]);
        assert_eq!(ended.code, Some(2), "{shard}: {}", ended.err);
        assert!(ended.err.contains("I/N") && ended.err.contains("--shard"), "{}", ended.err);
    }
    place.fail("out", &["--shard", "1/5"], 2, &["--shard 1/5", "4 tiles"]);
    assert!(!place.path("out").exists());
    let ended = place.sweep("out", &["--shard", "1/2", "--gather"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
}

#[test]
fn shards_that_disagree_are_not_merged() {
    let place = SceneFolder::new(&small());
    for shard in ["1/2", "2/2"] {
        place.succeed("out", &["--shard", shard]);
    }
    // cell (3, 25) lies on the border of two tiles
    let line = |text: &str| text.lines().find(|line| line.starts_with("3,25,")).expect("a cell").to_owned();
    place.edit("out/shards/2-of-2.csv", |text| {
        let line = line(text);
        text.replacen(&line, &with_error(&line, 0.125), 1)
    });
    place.fail("out", &["--gather"], 1, &["[3, 25]", ".csv"]);
    assert!(!place.has_results("out"));
}
