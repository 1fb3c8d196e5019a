//! Results say what determines them, are repeated from that, and belong to one version.
//!
//! `UPDATE_NUMBERS=1` writes the hashes of a version that is not released into `data/numbers.txt`.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::LazyLock;

use renderer::checkpoint::PROGRAM;
use renderer::provenance::{Contents, Kept, hash};
use tempfile::TempDir;

const SCENE: &str = r#"
format = 1
[film.spectral]
size = [8, 8]
spp = 4
bands_nm = [550, 680]
[camera.perspective]
position_m = [0, -0.3, 0.2]
look_at_m = [0, 0, 0]
vertical_fov_deg = 30
[meshes.plate.file]
path = "plate.obj"
[materials.leaf.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 8
water_cm = 0.01
dry_matter_g_per_cm2 = 0.005
[objects.plate]
mesh = "plate"
material = "leaf"
[lights.sky.constant]
radiance_w_m2_sr_nm = 0.05
[instruments.ball.sphere]
object = "plate"
wavelengths_nm = [550, 680]
"#;
const PLATE: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";

/// Runs the program with files of a folder, which words name by `@`.
fn run(folder: &Path, line: &str) -> ExitCode {
    let place = folder.display().to_string() + "/";
    let words = line
        .split_whitespace()
        .map(|word| word.replace('@', &place).into());
    renderer::cli::run(std::iter::once("lamina".into()).chain(words), PROGRAM)
}

/// Results of each kind, and what `lamina reproduce` needs for them.
const RESULTS: [(&str, &str); 9] = [
    ("figures.csv", "--scene @bench.toml"),
    ("figures.json", "--scene @bench.toml"),
    ("spectral.exr", "--scene @bench.toml"),
    ("leaf.csv", ""),
    ("colour.json", ""),
    ("contents.csv", "--input @leaf.csv"),
    ("contents.json", "--input @leaf.csv"),
    ("covariances.csv", "--input @leaf.csv"),
    ("spectra.csv", "--input @contents.csv"),
];

/// A folder with all of them, which each test may change.
fn results() -> TempDir {
    static FILES: LazyLock<Vec<(OsString, Vec<u8>)>> = LazyLock::new(|| {
        let folder = computed();
        let files = fs::read_dir(folder.path()).expect("a folder");
        let files = files.map(|file| file.expect("a file"));
        let read = |file: fs::DirEntry| (file.file_name(), fs::read(file.path()).expect("a file"));
        files.map(read).collect()
    });
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in &*FILES {
        fs::write(folder.path().join(name), bytes).expect("the folder can be written");
    }
    folder
}

fn computed() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("bench.toml"), SCENE).expect("the folder can be written");
    fs::write(at("plate.obj"), PLATE).expect("the folder can be written");
    for line in [
        "instruments @bench.toml --rays 512 --seed 3 --out @figures.csv @figures.json \
         -D materials.leaf.leaf.contents.chlorophyll_ug_per_cm2=20",
        "render @bench.toml --seed 5 --size 12x8 --out @spectral",
        "optics --cab 30 --out @leaf.csv --colour @colour.json",
        "fit @leaf.csv --range 400..800 --fix water=0.01 --fix dry_matter=0.008 --out @contents.csv \
         --covariance-out @covariances.csv",
        "fit @leaf.csv --range 400..800 --fix water=0.01 --fix dry_matter=0.008 --out @contents.json",
        "optics --table @contents.csv --nm 500,600 --out @spectra.csv",
    ] {
        assert_eq!(run(folder.path(), line), ExitCode::SUCCESS, "{line}");
    }
    folder
}

/// A result of which one digit behind the point of a number is another.
fn with_another_digit(text: &str) -> String {
    let comments = text.lines().take_while(|line| line.starts_with('#'));
    let start = comments.map(|line| line.len() + 1).sum();
    let numbers = text[start..]
        .match_indices("0.")
        .map(|(at, _)| start + at + 2);
    let is_long = |at: &usize| {
        text[*at..]
            .bytes()
            .take(6)
            .all(|byte| byte.is_ascii_digit())
    };
    let at = numbers
        .into_iter()
        .find(is_long)
        .expect("it has such a number")
        + 3;
    let digit = if &text[at..=at] == "7" { "3" } else { "7" };
    format!("{}{digit}{}", &text[..at], &text[at + 1..])
}

#[test]
fn a_result_of_each_kind_is_repeated_and_one_changed_digit_is_found() {
    let folder = results();
    let reproduce =
        |file: &str, needed: &str| run(folder.path(), &format!("reproduce @{file} {needed}"));
    for (file, needed) in RESULTS {
        assert_eq!(reproduce(file, needed), ExitCode::SUCCESS, "{file}");
        if !file.ends_with("exr") {
            let text = fs::read_to_string(folder.path().join(file)).expect("it was written");
            let other = format!("other-{file}");
            let changed = with_another_digit(&text);
            fs::write(folder.path().join(&other), changed).expect("the folder can be written");
            assert_eq!(reproduce(&other, needed), ExitCode::from(1), "{file}");
        }
        if !needed.is_empty() {
            assert_eq!(reproduce(file, ""), ExitCode::from(2), "{file}");
        }
    }
    // A picture with one other pixel.
    let at = folder.path().join("spectral.exr");
    let mut picture = renderer::image::openexr::read(&at).expect("it was written");
    picture.layers[0].data[5] += 1.0;
    renderer::image::openexr::write(&picture, &folder.path().join("other.exr")).expect("a folder");
    assert_eq!(
        reproduce("other.exr", "--scene @bench.toml"),
        ExitCode::from(1)
    );
}

#[test]
fn what_has_changed_since_is_refused_before_anything_is_computed() {
    let folder = results();
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("the folder can be written");
    };
    let scene = |file: &str| {
        run(
            folder.path(),
            &format!("reproduce @{file} --scene @bench.toml"),
        )
    };
    write(
        "bench.toml",
        &SCENE.replace("structure = 1.5", "structure = 1.6"),
    );
    assert_eq!(scene("figures.csv"), ExitCode::from(2));
    write(
        "bench.toml",
        &format!("# a comment changes nothing\n{SCENE}"),
    );
    assert_eq!(scene("figures.csv"), ExitCode::SUCCESS);
    write("plate.obj", &PLATE.replace("1 1 0", "1 1 0.1"));
    for file in ["figures.csv", "spectral.exr"] {
        assert_eq!(scene(file), ExitCode::from(2), "{file}");
    }
    write("leaf.csv", "wavelength_nm,R\n500,0.1\n");
    let line = "reproduce @contents.csv --input @leaf.csv";
    assert_eq!(run(folder.path(), line), ExitCode::from(2));
}

#[test]
fn a_provenance_runs_no_command_and_names_no_path() {
    let folder = results();
    let table = fs::read_to_string(folder.path().join("leaf.csv")).expect("it was written");
    let before = fs::read_dir(folder.path()).expect("a folder").count();
    let place = folder.path().display();
    let changes = [
        (
            r#""settings":{"#,
            format!(r#""settings":{{"layers":["{place}/written.csv"],"#),
        ),
        (
            r#""settings":{"#,
            r#""settings":{"list":["true"],"#.to_owned(),
        ),
        (
            r#""settings":{"#,
            r#""settings":{"no-such":["1"],"#.to_owned(),
        ),
        (
            r#""settings":{"#,
            format!(r#""settings":{{"n":["1","--layers={place}/written.csv"],"#),
        ),
        (
            r#""settings":{"#,
            format!(r#""overrides":["x --layers={place}/written.csv"],"settings":{{"#),
        ),
        (r#""option":"out""#, r#""option":"plot""#.to_owned()),
        (
            r#""option":"out""#,
            format!(r#""option":"layers={place}/written.csv --out""#),
        ),
        (r#""result":"optics""#, r#""result":"render""#.to_owned()),
        (r#""result":"optics""#, r#""result":"grow""#.to_owned()),
        (r#""complete":true"#, r#""complete":false"#.to_owned()),
        (
            r#""complete":true"#,
            format!(r#""complete":true,"files":{{"out":"{place}"}}"#),
        ),
        ("# provenance: {", "# provenance: {{".to_owned()),
        ("# provenance: ", "# ".to_owned()),
    ];
    for (from, to) in changes {
        assert!(table.contains(from), "{from}");
        let file = folder.path().join("hostile.csv");
        fs::write(&file, table.replacen(from, &to, 1)).expect("the folder can be written");
        let found = run(folder.path(), "reproduce @hostile.csv");
        assert_eq!(found, ExitCode::from(2), "{to}");
        fs::remove_file(file).expect("it was written");
    }
    let after = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(after, before, "something was written");
}

/// The hash of the numbers of a result, without its provenance.
fn hash_of_numbers(file: &Path) -> String {
    match Kept::read(file).expect("it is a result").contents {
        Contents::Picture(picture) => {
            let values = picture.layers.iter().flat_map(|layer| &layer.data);
            hash(
                &values
                    .flat_map(|value| value.to_le_bytes())
                    .collect::<Vec<u8>>(),
            )
        }
        Contents::Json(mut report) => {
            let members = report.as_object_mut().expect("results are objects");
            members.retain(|name, _| !["provenance", "program"].contains(&name.as_str()));
            hash(report.to_string().as_bytes())
        }
        Contents::Table(text) => {
            let lines = text.lines().filter(|line| !line.starts_with('#'));
            hash(lines.collect::<Vec<_>>().join("\n").as_bytes())
        }
    }
}

#[test]
fn numbers_change_with_the_version_alone() {
    let folder = results();
    let of = |(file, _): (&str, &str)| {
        let hash = hash_of_numbers(&folder.path().join(file));
        format!("{PROGRAM} {file} {hash}\n")
    };
    let found: String = RESULTS.map(of).concat();
    let list = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data/numbers.txt");
    let text = fs::read_to_string(&list).unwrap_or_default();
    let own = format!("{PROGRAM} ");
    let (known, others): (Vec<&str>, Vec<&str>) = text
        .split_inclusive('\n')
        .partition(|line| line.starts_with(&own));
    let known = known.concat();
    if known == found {
        return;
    }
    let changelog = include_str!("../CHANGELOG.md");
    let is_released = changelog.contains(&format!("\n## {PROGRAM}"));
    if std::env::var_os("UPDATE_NUMBERS").is_some() && !is_released {
        fs::write(&list, others.concat() + &found).expect("the list can be written");
        return;
    }
    let advice = if is_released {
        "it is released, so raise the version, as `When a version rises` in docs/src/contributing.md says, \
         or find out why the numbers have changed"
    } else {
        "it is not released: if the numbers should have changed, say so in CHANGELOG.md and run this test with \
         UPDATE_NUMBERS=1; otherwise find out why they have"
    };
    panic!("other numbers than version {PROGRAM} has had: {advice}\nkept:\n{known}found:\n{found}");
}
