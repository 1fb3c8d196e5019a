//! Broken scenes, and the reports that they get.

use std::fs;

use super::{codes, folder, load, own_folder, refuse, text_of};

/// Every `broken/*.toml` prints what stands in the `.txt` beside it; with `UPDATE_SNAPSHOTS=1`
/// the text is written instead.
#[test]
fn every_broken_scene_gets_the_report_that_is_kept_beside_it() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut names: Vec<_> = fs::read_dir(own_folder().join("broken"))
        .expect("the folder is part of the tests")
        .map(|entry| entry.expect("the folder is readable").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    names.sort();
    assert!(names.len() >= 30, "only {} broken scenes", names.len());
    let mut different = Vec::new();
    for path in names {
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .expect("names are ASCII");
        let text = fs::read_to_string(&path).expect("the test's own file is there");
        let report = format!("{}\n", refuse(&text, name, &[]));
        let kept = path.with_extension("txt");
        if update {
            fs::write(&kept, report).expect("the folder is writable");
        } else if fs::read_to_string(&kept).ok().as_deref() != Some(&report) {
            different.push(report);
        }
    }
    assert!(
        different.is_empty(),
        "other reports than those kept:\n{}",
        different.join("\n")
    );
}

#[test]
fn a_file_with_five_errors_gets_five() {
    let errors = refuse(&text_of("broken/five_errors.toml"), "five_errors.toml", &[]);
    assert_eq!(
        codes(&errors),
        [
            "scene::out_of_range",
            "scene::unknown_key",
            "scene::not_finite",
            "scene::wrong_type",
            "scene::unknown_name"
        ]
    );
}

#[test]
fn a_line_of_another_format_is_shown_as_toml_has_it() {
    let minimal = text_of("minimal.toml");
    for (line, meant) in [
        ("spp: 8", "write `spp = 8`"),
        ("\"spp\": 8,", "write `spp = 8`"),
        ("name: leaf", "write `name = \"leaf\"`"),
    ] {
        let text = format!("{minimal}\n{line}\n");
        let report = refuse(&text, "colon.toml", &[]).to_string();
        assert!(
            report.contains("scene::syntax") && report.contains(meant),
            "{report}"
        );
    }
    let report = refuse(&format!("{minimal}\n[film.rgb\n"), "open.toml", &[]).to_string();
    assert!(!report.contains("write `"), "{report}");
}

#[test]
fn errors_of_overrides_point_into_the_override() {
    let minimal = text_of("minimal.toml");
    for (text, code, shown) in [
        ("film.rgb.spp=0", "scene::out_of_range", "-D:1:14"),
        ("film.rgb.noise=2", "scene::out_of_range", "-D:1:16"),
        ("film.rgb.ssp=4", "scene::unknown_key", "-D:1:10"),
        ("film.rgb.spp", "scene::override", "without `=`"),
        (
            "film.rgb.spp:4",
            "scene::override",
            "write `film.rgb.spp = 4`",
        ),
        ("film.rgb.spp=", "scene::override", "value is missing"),
        ("picture.tone=filmc", "scene::unknown_word", "filmic"),
        ("picture.tone=\"filmic", "scene::syntax", "-D:1:21"),
        (
            "objects.flor.position_m=[0, 0, 1]",
            "scene::unknown_name",
            "-D:1:9",
        ),
        ("film.rgb.spp.x=4", "scene::override", "-D:1:10"),
        ("[film.rgb]\nspp=4", "scene::override", "several lines"),
        ("[film.rgb] #=", "scene::override", "-D:1:1"),
        (
            "objects.floor.mesh=\"flour\"",
            "scene::unknown_name",
            "-D:1:20",
        ),
        (
            "camera.perspective.vertical_fov_deg=nan",
            "scene::not_finite",
            "-D:1:37",
        ),
    ] {
        let errors = refuse(&minimal, "minimal.toml", &[text]);
        assert_eq!(codes(&errors), [code], "{text}");
        let report = errors.to_string();
        assert!(report.contains(shown), "{text} gives\n{report}");
    }
}

#[test]
fn a_date_where_text_is_wanted_is_to_be_put_in_quotes() {
    let text = format!("name = 2026-06-21\n{}", text_of("minimal.toml"));
    let errors = refuse(&text, "dated.toml", &[]);
    assert_eq!(codes(&errors), ["scene::wrong_type"]);
    let report = errors.to_string();
    assert!(
        report.contains("put it in quotes: \"2026-06-21\""),
        "{report}"
    );
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_is_refused_and_one_inside_is_not() {
    let outside = folder();
    let inside = folder();
    let link = |target: &std::path::Path, name: &str| {
        std::os::unix::fs::symlink(target, inside.path().join(name))
            .expect("the folder takes links");
    };
    link(&outside.path().join("pot.ply"), "secret.ply");
    link(&outside.path().join("maps"), "elsewhere");
    link(&inside.path().join("pot.ply"), "own.ply");
    for (path, expected) in [
        ("secret.ply", Some("scene::path_outside")),
        ("elsewhere/../pot.ply", Some("scene::path_outside")),
        ("own.ply", None),
        ("maps/../pot.ply", None),
    ] {
        let mesh = format!("[meshes.floor.file]\npath = \"{path}\"\n");
        let text = text_of("minimal.toml").replace(
            "[meshes.floor.rectangle]\nwidth_m = 1\nheight_m = 1\n",
            &mesh,
        );
        let outcome = renderer::scene::load::parse(&text, "linked.toml", inside.path(), &[]);
        let found = outcome.as_ref().err().map(codes);
        assert_eq!(found, expected.map(|code| vec![code]), "{path}");
    }
}

#[test]
fn files_that_are_no_scene_are_refused_before_they_are_read() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let write =
        |name: &str, bytes: &[u8]| fs::write(path(name), bytes).expect("the folder was just made");
    write("latin.toml", b"format = 1\nname = \"bl\xe4tter\"\n");
    write("large.toml", &vec![b'#'; (16 << 20) + 1]);
    for (name, code, shown) in [
        ("latin.toml", "scene::not_utf8", "byte 21 (line 2)"),
        ("large.toml", "scene::bad_file", "more than the 16777216"),
        ("absent.toml", "scene::file_missing", "absent.toml"),
        ("maps", "scene::not_a_regular_file", "maps"),
    ] {
        let errors = load(&path(name), &[])
            .err()
            .unwrap_or_else(|| panic!("{name} was accepted"));
        assert_eq!(codes(&errors), [code], "{name}");
        assert!(errors.to_string().contains(shown), "{name} gives {errors}");
    }
}

#[test]
fn deep_nesting_and_floods_of_errors_end_in_a_short_report() {
    let deep = format!("format = {}1{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(codes(&refuse(&deep, "deep.toml", &[])).contains(&"scene::syntax"));
    let joined = |block: &dyn Fn(usize) -> String| {
        let blocks: Vec<String> = (0..50_000).map(block).collect();
        blocks.join("\n")
    };
    for many in [
        joined(&|index| format!("key{index} = 1")),
        joined(&|index| format!("[objects.o{index}]\nmesh = \"m{index}\"")),
        joined(&|_| "= =".to_owned()),
    ] {
        let report = refuse(&many, "many.toml", &[]).to_string();
        assert!(
            report.len() < 40_000,
            "the report has {} bytes",
            report.len()
        );
    }
    let long = format!("format = 1\nx = [{}]\n", "nan, ".repeat(100_000));
    assert!(refuse(&long, "long.toml", &[]).to_string().len() < 10_000);
}

#[test]
fn no_report_carries_control_characters() {
    for text in [
        "\"a\\u001b[2J\\u202e\" = 1",
        "name = \"\\u001b]0;x\\u0007\"",
        "x = \u{1b}[31m",
        "format = \"\u{7f}\"",
    ] {
        let report = refuse(text, "\u{1b}[1mevil.toml", &[]).to_string();
        let bad = report
            .chars()
            .find(|c| (c.is_control() && *c != '\n') || *c == '\u{202e}');
        assert_eq!(bad, None, "{report:?}");
    }
}
