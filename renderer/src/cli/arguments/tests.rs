use super::*;

fn parsed(line: &str) -> Result<Arguments, clap::Error> {
    Arguments::of_line(line.split(' '))
}

#[test]
fn the_command_line_has_no_contradictions() {
    Arguments::command().debug_assert();
    assert_eq!(GREETING.lines().count(), 5);
}

#[test]
fn render_takes_all_its_options() {
    let line = "lamina render a.toml --out b --spp 9 --threads 2 --seed 7 --noise 0.01 --time 1.5 -D x.y=1 -D z=2 --cache c \
                --stats s.json";
    let arguments = parsed(line).expect("the line is right");
    let Some(Command::Render(render)) = arguments.command else {
        panic!("{line} is no render");
    };
    assert_eq!(render.scene.overrides, ["x.y=1", "z=2"]);
    assert_eq!(
        (render.spp, render.threads, render.seed),
        (Some(9), Some(2), Some(7))
    );
    assert_eq!((render.noise, render.time), (Some(0.01), Some(1.5)));
    assert_eq!(render.cache.cache, Some(PathBuf::from("c")));
}

#[test]
fn overrides_may_be_negative_and_hold_equals_signs() {
    let arguments =
        parsed("lamina check a.toml -Dpicture.exposure_ev=-1").expect("the line is right");
    let Some(Command::Check(check)) = arguments.command else {
        panic!("no check");
    };
    assert_eq!(check.scene.overrides, ["picture.exposure_ev=-1"]);
}

#[test]
fn bad_arguments_end_with_code_2() {
    for line in [
        "lamina paint",
        "lamina render",
        "lamina render a.toml --spp 0",
        "lamina render a.toml --spp 1099511627776",
        "lamina render a.toml --threads 0",
        "lamina render a.toml --noise -0.1",
        "lamina render a.toml --noise 1.5",
        "lamina render a.toml --noise nan",
        "lamina render a.toml --noise little",
        "lamina render a.toml --time -1",
        "lamina render a.toml --time inf",
        "lamina render a.toml --time 10s",
        "lamina render a.toml --samples-map m.exr --noise 0.1",
        "lamina render a.toml --samples-map m.exr --samples 0..4",
        "lamina render a.toml --samples 5",
        "lamina render a.toml --samples 5..5",
        "lamina render a.toml --samples 8..4",
        "lamina render a.toml --samples 0..1048577",
        "lamina render a.toml --samples -1..4",
        "lamina merge --out a",
        "lamina merge a.part",
        "lamina optics --n 0.5 --out a.csv",
        "lamina optics --cab nan --out a.csv",
        "lamina optics --cab -1 --out a.csv",
        "lamina optics --betacyanins -1 --out a.csv",
        "lamina optics",
        "lamina optics --cab 3",
        "lamina optics --list --out a.csv",
        "lamina optics --preset sun-green --presett x --out a.csv",
        "lamina export pbrt a.toml --out b",
        "lamina compare a.exr",
        "lamina tonemap a.exr",
        "lamina grow",
        "lamina grow --list poplar",
        "lamina grow poplar --frames 0",
        "lamina grow poplar --size 8",
    ] {
        let error = parsed(line).expect_err(line);
        assert_eq!(error.exit_code(), 2, "{line}");
    }
}

#[test]
fn a_negative_number_gets_the_range_of_its_option() {
    for (line, range) in [
        ("lamina optics --cab -3 --colour", "from 0 to 1000"),
        (
            "lamina grow poplar --frames -2 --out a.svg",
            "-2 is not in 1..=10000",
        ),
        ("lamina render a.toml --spp -8", "-8 is not in 1..="),
        (
            "lamina instruments a.toml --out a.csv --time -1",
            "must be from 0 to",
        ),
        ("lamina render a.toml --size 7", "640x480"),
        ("lamina render a.toml --size -8x8", "640x480"),
        ("lamina render a.toml --noise -1e-3", "must be from 0 to 1"),
        (
            "lamina instruments a.toml --out a.csv --error -1e-3",
            "must be from 0 to 1",
        ),
        (
            "lamina instruments a.toml --out a.csv --error -5%",
            "must be from 0 to 100",
        ),
    ] {
        let error = parsed(line).expect_err(line).to_string();
        assert!(error.contains(range), "{error}");
    }
    let line = "lamina render a.toml --size 7x5 --allow b --allow c";
    let arguments = parsed(line).expect("the line is right");
    assert_eq!(arguments.allow, ["b", "c"].map(PathBuf::from));
    let Some(Command::Render(render)) = arguments.command else {
        panic!("no render");
    };
    assert_eq!(render.size, Some([7, 5]));
}

#[test]
fn a_leaf_of_a_scene_is_named_behind_the_number_sign() {
    for (line, file, leaf) in [
        (
            "lamina grow s.toml#beech --out a.svg",
            "s.toml",
            Some("beech"),
        ),
        ("lamina grow s.toml --out a.svg b.ply", "s.toml", None),
        ("lamina grow a#b/s.toml --seed 3", "a#b/s.toml", None),
    ] {
        let Some(Command::Grow(grow)) = parsed(line).expect(line).command else {
            panic!("{line} is no grow");
        };
        let named = grow.leaf.expect("a leaf is named");
        assert_eq!(file_and_leaf(&named), (PathBuf::from(file), leaf));
    }
}

#[test]
fn nothing_asked_is_nothing_to_do() {
    assert!(
        parsed("lamina")
            .expect("the line is right")
            .command
            .is_none()
    );
}

#[test]
fn groups_of_leaves_are_distinguished() {
    let line = "lamina compare-networks --group sun a.svg b.svg --out x.html --group shade c=1.svg";
    let arguments = parsed(line).expect("the line is right");
    let Some(Command::CompareNetworks(compare)) = arguments.command else {
        panic!("{line} is another command");
    };
    let named: Vec<(&str, usize)> = compare
        .groups
        .0
        .iter()
        .map(|group| (group.name.as_str(), group.leaves.len()))
        .collect();
    assert_eq!(named, [("sun", 2), ("shade", 1)]);
    assert_eq!(compare.groups.0[1].leaves, ["c=1.svg"]);
    assert!(compare.networks.is_empty());
    for wrong in [
        "lamina compare-networks --group sun",
        "lamina compare-networks x.svg --group sun a.svg",
        "lamina compare-networks --table t.csv --group sun a.svg",
        "lamina compare-networks a.svg b.svg --align upside-down",
        "lamina compare-networks a.svg b.svg --area 3 --outline m.svg",
    ] {
        assert!(parsed(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn a_column_of_a_table_says_what_its_flag_would() {
    let mut reading = ReadingArguments::default();
    assert_eq!(reading.first(), None);
    let words = ["n.csv", "o.svg", "3.5", "0.01", "true", "1,-2"];
    for (column, word) in ReadingArguments::COLUMNS.into_iter().zip(words) {
        reading.set(column, word).expect("a good word");
        assert!(reading.first().is_some(), "{column}");
    }
    let line = "lamina measure x.csv --nodes n.csv --mm-per-unit 0.01 --y-down --root 1,-2 --outline o.svg";
    let arguments = parsed(line).expect("the line is right");
    let Some(Command::Measure(measure)) = arguments.command else {
        panic!("{line} is another command");
    };
    assert_eq!(
        ReadingArguments {
            area: None,
            ..reading.clone()
        },
        measure.reading
    );
    assert_eq!(reading.area, Some(3.5));
    for (column, word) in [
        ("area_mm2", "0"),
        ("y_down", "yes"),
        ("root", "1"),
        ("size", "1"),
    ] {
        assert!(reading.set(column, word).is_err(), "{column} = {word}");
    }
}
