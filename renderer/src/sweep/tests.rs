use std::fs;
use std::path::Path;

use super::*;

/// The sweep of a file beside a table `rows.csv`.
fn of(text: &str, rows: &str) -> Result<Sweep, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("the folder can be written");
        path
    };
    write("scene.toml", "");
    write("rows.csv", rows);
    let path = write("sweep.toml", text);
    Sweep::file(&path, &Words::default()).map_err(|errors| {
        let shown = format!("{}/", folder.path().display());
        errors.to_string().replace(&shown, "")
    })
}

fn good(text: &str, rows: &str) -> Sweep {
    let text = format!("format = 1\nscene = \"scene.toml\"\n{text}");
    of(&text, rows).unwrap_or_else(|report| panic!("{report}"))
}

#[test]
fn rows_with_decimal_commas_set_numbers_and_a_note_names_the_key() {
    let table = "a;b\n0,5;red\n1;1,5\n";
    let sweep = good("rows = \"rows.csv\"\n", table);
    assert_eq!(all(&sweep), ["a=0.5 b=red", "a=1 b=1.5"]);
    let [note] = sweep.notes.as_slice() else {
        panic!("{:?}", sweep.notes);
    };
    assert!(note.contains("write `decimal = \"point\"`"), "{note}");
    let known = good(
        "rows = \"rows.csv\"\nseparator = \"semicolon\"\ndecimal = \"point\"\n",
        table,
    );
    assert_eq!(all(&known), ["a=0,5 b=red", "a=1 b=1,5"]);
    assert_eq!(known.notes, [""; 0]);
}

/// The settings of all tasks, one line each, a seed behind them.
fn all(sweep: &Sweep) -> Vec<String> {
    let line = |number| {
        let task = sweep.task(number);
        let mut line: Vec<String> = task.overrides().collect();
        line.extend(task.seed.map(|seed| format!("seed {seed}")));
        line.join(" ")
    };
    (0..sweep.len()).map(line).collect()
}

fn over(words: &[&str]) -> Result<Sweep, String> {
    let over: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
    let words = Words {
        over: &over,
        ..Words::default()
    };
    Sweep::words(Target::Leaf("birch".to_owned()), "birch", &words)
        .map_err(|errors| errors.to_string())
}

#[test]
fn a_grid_combines_everything_and_the_last_changes_fastest() {
    let sweep = good(
        "seeds = [4, 9]\n[grid]\n\"a.b\" = [\"x y\", { d65 = 0.5 }]\nc.d.e = { from = 1, to = 2, count = 3 }\n",
        "",
    );
    let expected = [
        "a.b=\"x y\" c.d.e=1 seed 4",
        "a.b=\"x y\" c.d.e=1 seed 9",
        "a.b=\"x y\" c.d.e=1.5 seed 4",
        "a.b=\"x y\" c.d.e=1.5 seed 9",
        "a.b=\"x y\" c.d.e=2 seed 4",
        "a.b=\"x y\" c.d.e=2 seed 9",
        "a.b={ d65 = 0.5 } c.d.e=1 seed 4",
    ];
    assert_eq!(all(&sweep)[..7], expected);
    assert_eq!(sweep.len(), 12);
    let target = sweep.target;
    assert!(matches!(target, Target::Scene(path) if path.ends_with("scene.toml")));
}

#[test]
fn a_list_goes_side_by_side_and_all_kinds_combine() {
    let sweep = good(
        "rows = \"rows.csv\"\n[set]\nfixed.key = 3\nlight = { d65 = 1 }\n[list]\na = [1, 2]\nb = [true, false]\n",
        "c , d\n# told\n.5,\"[1, 2]\"\n1e3,word\n",
    );
    let expected = [
        "a=1 b=true c=0.5 d=[1, 2]",
        "a=1 b=true c=1000 d=word",
        "a=2 b=false c=0.5 d=[1, 2]",
        "a=2 b=false c=1000 d=word",
    ];
    assert_eq!(all(&sweep), expected);
    assert_eq!(sweep.fixed, ["fixed.key=3", "light={ d65 = 1 }"]);
}

#[test]
fn a_hypercube_has_a_row_for_each_task() {
    let text = "[latin_hypercube]\ncount = 8\nseed = 3\n[latin_hypercube.ranges]\n\
                a = { from = 0, to = 8 }\nb.c = { from = 1, to = 256, scale = \"logarithmic\", whole = true }\n";
    let sweep = good(text, "");
    assert_eq!(sweep.len(), 8);
    let mut parts: Vec<u32> = (0..8)
        .map(|number| {
            let text = &sweep.task(number).settings[0].1.text;
            text.parse::<f64>().expect("a number") as u32
        })
        .collect();
    parts.sort_unstable();
    assert_eq!(parts, [0, 1, 2, 3, 4, 5, 6, 7]);
    assert!(all(&sweep).iter().all(|line| !line.contains("b.c=0")));
    assert_eq!(all(&sweep), all(&good(text, "")));
}

#[test]
fn ranges_are_evenly_spaced_or_by_ratios_and_end_exactly() {
    let numbers = |text: &str| -> Vec<String> {
        let sweep = good(&format!("[grid]\na = {text}\n"), "");
        let texts = (0..sweep.len()).map(|number| sweep.task(number).settings[0].1.text.clone());
        texts.collect()
    };
    assert_eq!(
        numbers("{ from = 0.1, to = 0.5, count = 5 }"),
        ["0.1", "0.2", "0.3", "0.4", "0.5"]
    );
    assert_eq!(
        numbers("{ from = 2, to = 6, count = 5 }"),
        ["2", "3", "4", "5", "6"]
    );
    assert_eq!(
        numbers("{ from = 1, to = 100, count = 3, scale = \"logarithmic\" }"),
        ["1", "10", "100"]
    );
    assert_eq!(
        numbers("{ from = 0, to = 10, count = 3, whole = true }"),
        ["0", "5", "10"]
    );
}

#[test]
fn words_of_a_command_line_are_lists_and_ranges() {
    let sweep = over(&["a=1, 2,.5", "b=10..60/3", "c=[1,2],\"x,y\",z"]).expect("good words");
    assert_eq!(sweep.len(), 27);
    assert_eq!(all(&sweep)[0], "a=1 b=10 c=[1,2]");
    assert_eq!(all(&sweep)[26], "a=0.5 b=60 c=z");
    assert_eq!(all(&sweep)[13], "a=2 b=35 c=\"x,y\"");
}

#[test]
fn times_of_one_day_are_evenly_spaced_and_others_are_refused() {
    let day = |from: &str, to: &str| over(&[&format!("t=2026-06-21T{from}..2026-06-21T{to}/3")]);
    let sweep = day("06:00:00+02:00", "07:00:01+02:00").expect("times of a day");
    assert_eq!(
        all(&sweep),
        [
            "t=\"2026-06-21T06:00:00+02:00\"",
            "t=\"2026-06-21T06:30:01+02:00\"",
            "t=\"2026-06-21T07:00:01+02:00\"",
        ]
    );
    for (from, to, problem) in [
        ("06:00:00Z", "07:00:00+02:00", "on one day, with one offset"),
        ("06:00:00Z", "06:00:00Z", "begins and ends at one time"),
    ] {
        let report = day(from, to).expect_err("no range");
        assert!(report.contains(problem), "{report}");
    }
}

/// A sweep file behind its head, the table beside it, and pieces of the one report.
const SLIPS: &[(&str, &str, [&str; 3])] = &[
    (
        "[grid]\na = []\n",
        "",
        ["sweep.toml:4:5", "`a`: has no values", "at least one value"],
    ),
    (
        "[grid]\n",
        "",
        ["sweep.toml:3:2", "`grid`: is empty", "write keys"],
    ),
    (
        "",
        "",
        ["--> sweep.toml", "nothing is varied", "[latin_hypercube]"],
    ),
    (
        "[grid]\na = [1, nan]\n",
        "",
        ["sweep.toml:4:9", "not a finite number", "finite"],
    ),
    (
        "[grid]\na = 3\n",
        "",
        [
            "sweep.toml:4:5",
            "a list of values, or { from, to, count }",
            "",
        ],
    ),
    (
        "[grid]\na = { from = 1, count = 3 }\n",
        "",
        ["sweep.toml:4:1", "[a] lacks `to`", "where the range ends"],
    ),
    (
        "[grid]\na = { from = 1, to = 3 }\n",
        "",
        ["sweep.toml:4:1", "[a] lacks `count`", "2 or more"],
    ),
    (
        "[grid]\na = { from = 1, to = 3, cuont = 3 }\n",
        "",
        ["sweep.toml:4:", "no key `cuont`", "did you mean `count`?"],
    ),
    (
        "[grid]\na = { from = 1, to = 1, count = 3 }\n",
        "",
        ["sweep.toml:4:1", "begins and ends at 1", "elsewhere"],
    ),
    (
        "[grid]\na = { from = 0, to = 1, count = 3, scale = \"logarithmic\" }\n",
        "",
        [
            "sweep.toml:4:1",
            "logarithmic range from 0",
            "greater than 0",
        ],
    ),
    (
        "[grid]\na = { from = 0, to = 1, count = 3, scale = \"log\" }\n",
        "",
        ["sweep.toml:4:", "must be one of", "linear"],
    ),
    (
        "[grid]\na = [1]\n[list]\na = [2]\n",
        "",
        ["sweep.toml:6:1", "varied twice", "keep one"],
    ),
    (
        "[list]\na = [1, 2]\nb = [1]\n",
        "",
        [
            "sweep.toml:5:5",
            "has 1 values, `a` has 2",
            "[grid] combines",
        ],
    ),
    (
        "[gird]\na = [1]\n",
        "",
        ["sweep.toml:3:2", "no key `gird`", "did you mean `grid`?"],
    ),
    ("seeds = 0\n", "", ["sweep.toml:3:9", "`seeds` is 0", ""]),
    (
        "seeds = [4, 9, 4]\n",
        "",
        ["sweep.toml", "has the seed 4 twice", ""],
    ),
    (
        "[grid]\na = [0.1, 0.2, 0.10]\n",
        "",
        [
            "sweep.toml:4:16",
            "has the value 0.1 twice",
            "each value once",
        ],
    ),
    (
        "[grid]\na = { from = 1, to = 9, count = 99999999 }\n",
        "",
        ["sweep.toml:4:", "outside", "10000000"],
    ),
    (
        "[latin_hypercube]\ncount = 4\n",
        "",
        ["sweep.toml:3:2", "lacks `ranges`", "from = …, to = …"],
    ),
    (
        "[latin_hypercube]\ncount = 4\nranges.a = [1, 2]\n",
        "",
        ["sweep.toml:5:", "a range { from, to }", ""],
    ),
    (
        "rows = \"none.csv\"\n",
        "",
        ["sweep.toml:3:8", "there is no file", ""],
    ),
    (
        "rows = \"rows.csv\"\n",
        "a,b\n",
        ["sweep.toml:3:8", "has no rows", "a line for each task"],
    ),
    (
        "rows = \"rows.csv\"\n",
        "a,b\n1,2\n3,NaN\n",
        [
            "rows.csv:3:3",
            "`b` is NaN, which is not a finite number",
            "",
        ],
    ),
    (
        "rows = \"rows.csv\"\n",
        "a,b\n1,\n",
        ["rows.csv:2:", "`b`: has an empty value", "write a value"],
    ),
    (
        "rows = \"rows.csv\"\n",
        "a,b\n1,2\n3\n",
        [
            "rows.csv:3:1",
            "the line has 1 values, but there are 2 columns",
            "one value for each name",
        ],
    ),
    (
        "rows = \"rows.csv\"\n",
        "a,\n1,2\n",
        [
            "rows.csv:1:",
            "a column without a key",
            "the key that the column sets",
        ],
    ),
];

#[test]
fn what_is_wrong_is_reported_once_with_its_place_and_what_is_allowed() {
    let head = "format = 1\nscene = \"scene.toml\"\n";
    for (text, rows, expected) in SLIPS {
        let report = of(&format!("{head}{text}"), rows).expect_err(text);
        for piece in *expected {
            assert!(
                report.contains(piece),
                "{piece} is not told of\n{text}{rows}\n{report}"
            );
        }
        assert!(report.ends_with(": 1 error"), "{report}");
    }
    let missing = of("format = 1\nscene = \"none.toml\"\nseeds = 2\n", "").expect_err("no scene");
    assert!(
        missing.contains("sweep.toml:2:9") && missing.contains("there is no file"),
        "{missing}"
    );
    let format = of("format = 2\nleaf = \"birch\"\nseeds = 2\n", "").expect_err("no format 2");
    assert!(format.contains("format 2 is unknown"), "{format}");
}

#[test]
fn slips_in_words_are_reported_with_their_places() {
    for (word, expected) in [
        ("a", ["--over:1:1", "lacks its values"]),
        ("=1", ["--over:1:1", "lacks its key"]),
        ("a=1,,2", ["--over:1:5", "has an empty value"]),
        ("a=", ["--over:1:3", "has an empty value"]),
        ("a=1..", ["--over:1:3", "1.. lacks the number of values"]),
        ("a=1../5", ["--over:1:3", "1../5 lacks its end"]),
        ("a=..3/5", ["--over:1:3", "..3/5 lacks its start"]),
        ("a=1..x/5", ["--over:1:3", "x is no finite number"]),
        ("a=1..inf/5", ["--over:1:3", "inf is no finite number"]),
        ("a=1..2/1", ["--over:1:3", "a number from 2 to"]),
        ("a=2..2/3", ["--over:1:3", "begins and ends at 2"]),
        ("a=1,nan", ["--over:1:5", "not a finite number"]),
    ] {
        let report = over(&[word]).expect_err(word);
        for piece in expected {
            assert!(
                report.contains(piece),
                "{piece} is not told of {word}\n{report}"
            );
        }
        assert!(report.ends_with("birch: 1 error"), "{report}");
    }
    let report = over(&["a=1", "a=2"]).expect_err("twice");
    assert!(report.contains("varied twice"), "{report}");
    for (values, place) in [
        ("0.1,0.1", "--over:1:7"),
        ("1,2,1", "--over:1:7"),
        ("x,y,x", "--over:1:7"),
    ] {
        let report = over(&[&format!("a={values}")]).expect_err(values);
        assert!(
            report.contains(place) && report.contains("twice"),
            "{report}"
        );
    }
    for (key, seeds, spp, said) in [
        (
            "film.rgb.seed",
            Some(2),
            None,
            "varied twice: by the seeds too",
        ),
        ("seed", Some(2), None, "varied twice: by the seeds too"),
        (
            "film.spectral.spp",
            None,
            Some(4),
            "is varied, and --spp sets it",
        ),
    ] {
        let axis = [format!("{key}=1,2")];
        let words = Words {
            over: &axis,
            seeds,
            spp,
            ..Words::default()
        };
        let swept = Sweep::words(Target::Scene("s.toml".into()), "s.toml", &words);
        let report = swept.expect_err(key).to_string();
        assert!(report.contains(said), "{report}");
    }
    let other = over(&["leaves.oak.seed=1,2", "seeds=1,2"]);
    assert!(other.is_ok(), "each is a key of its own");
    let many = over(&["a=0..1/9999999", "b=0..1/2"]).expect_err("too many");
    assert!(
        many.contains("19999998 tasks, more than 10000000"),
        "{many}"
    );
}

#[test]
fn errors_of_the_scene_are_reported_where_the_sweep_causes_them() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/flat-leaf/scene.toml");
    let words = [
        "film.spectral.spp=4,many",
        "camera.perspective.fov=3",
        "lights.sun.distant.angular_diameter_deg=4,-1",
    ];
    let over = words.map(str::to_owned);
    let words = Words {
        over: &over,
        ..Words::default()
    };
    let sweep = Sweep::words(Target::Scene(path.clone()), "scene.toml", &words);
    let sweep = sweep.expect("good words");
    let mut refused = Refused::default();
    for number in 0..sweep.len() {
        let task = sweep.task(number);
        let overrides: Vec<String> = task.overrides().collect();
        if let Err(errors) = crate::scene::load::load(&path, &overrides) {
            refused.add(&sweep, &task, &errors);
        }
    }
    let report = refused.render(&sweep, false);
    for piece in [
        "--over:1:21",
        "--over:1:1",
        "no key `fov`",
        "--over:1:43",
        "outside",
    ] {
        assert!(report.contains(piece), "{piece} is not in\n{report}");
    }
    assert!(report.ends_with("scene.toml: 3 errors\n"), "{report}");
}
