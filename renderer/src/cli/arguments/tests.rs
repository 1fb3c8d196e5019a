use clap::CommandFactory;

use super::*;

fn parsed(line: &str) -> Result<Arguments, clap::Error> {
    Arguments::try_parse_from(line.split(' '))
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
    assert_eq!(render.cache, Some(PathBuf::from("c")));
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
