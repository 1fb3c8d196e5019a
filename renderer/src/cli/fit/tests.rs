use clap::Parser;
use leafmodel::optics::{Model, ProspectD};

use serde_json::{Value as Json, json};

use super::*;
use crate::cli::arguments::{Arguments, Command};

/// R of a leaf at wavelengths in nm.
fn leaf(nm: impl Iterator<Item = f64>) -> Leaf {
    let contents = Contents::prospect_d([1.6, 42.0, 9.0, 1.0, 0.1, 0.012, 0.006]);
    let nm: Vec<f64> = nm.collect();
    let at = |nm: &f64| ProspectD::coefficients(*nm).expect("within the table");
    let reflectance = |nm: &f64| at(nm).reflectance_transmittance(&contents).reflectance;
    Leaf {
        name: "l3".to_owned(),
        reflectance: nm.iter().map(reflectance).collect(),
        nm,
        ..Leaf::default()
    }
}

/// All contents of PROSPECT-D are looked for.
fn of_prospect_d() -> Question {
    question(&[]).expect("nothing is asked but the usual")
}

/// The question of a command line with these words.
fn question(words: &[&str]) -> Result<Question, Failure> {
    let line = ["lamina", "fit", "leaf.csv"].iter().chain(words);
    let Some(Command::Fit(arguments)) = Arguments::parse_from(line).command else {
        panic!("it is this command");
    };
    Question::of(&arguments)
}

#[test]
fn priors_are_means_with_deviations_or_ranges_of_what_is_looked_for() {
    let words = [
        "--prior",
        "water=0.01 +- 0.002",
        "--prior",
        "chlorophyll=20..60",
    ];
    let priors = question(&words).expect("good priors").priors;
    let (mean, deviation) = (0.01, 0.002);
    assert_eq!(
        priors[Constituent::Water],
        Some(Prior::Normal { mean, deviation })
    );
    assert_eq!(
        priors[Constituent::Chlorophyll],
        Some(Prior::Within([20.0, 60.0]))
    );
    assert_eq!(priors[Constituent::Brown], None);
    for (words, problem) in [
        (
            vec!["--prior", "water=0.01"],
            "write a mean and a standard deviation",
        ),
        (vec!["--prior", "water=0.02..0.01"], "write a mean"),
        (vec!["--prior", "water=0.01+-0"], "write a mean"),
        (vec!["--prior", "water=-1+-2"], "from 0 to 1"),
        (
            vec!["--prior", "proteins=0.001+-0.0005"],
            "proteins is not looked for",
        ),
        (vec!["--prior", "moss=1+-1"], "there is no content `moss`"),
        (
            vec!["--prior", "water=0..1", "--prior", "water=0..0.5"],
            "has a prior already",
        ),
        (
            vec!["--model", "prospect-4", "--free", "proteins"],
            "neither free nor known",
        ),
        (
            vec!["--fix", "anthocyanins=2", "--model", "prospect-5"],
            "PROSPECT-5 has no anthocyanins",
        ),
    ] {
        let error = question(&words).err().expect("it is refused");
        let error = format!("{error:?}");
        assert!(error.contains(problem), "{words:?}: {error}");
    }
}

fn unknown() -> Provenance {
    Provenance::of("fit", "out", &Settings::new())
}

#[test]
fn contents_that_a_spectrum_does_not_determine_are_empty_with_the_reason() {
    let leaf = leaf((0..61).map(|i| 1300.0 + 20.0 * f64::from(i)));
    let (leaves, question) = ([leaf], of_prospect_d());
    let free = &question.free;
    let fitted = question.answers(&leaves).expect("within the table");
    let text = contents(&fitted, free);
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let at = |key: &str| {
        rows[0]
            .iter()
            .position(|name| *name == key)
            .expect("a column")
    };
    let report: Json =
        serde_json::from_str(&report(&unknown(), &fitted, free, Model::ProspectD)).expect("JSON");
    for &of in free {
        let is_pigment = !matches!(
            of,
            Constituent::Structure | Constituent::Water | Constituent::DryMatter
        );
        let error = format!("{}_standard_error", of.key());
        assert_eq!(rows[1][at(of.key())].is_empty(), is_pigment, "{text}");
        assert_eq!(rows[1][at(&error)].is_empty(), is_pigment, "{text}");
        let said = format!("{}: these values do not depend on it", of.name());
        assert_eq!(rows[1][at("reasons")].contains(&said), is_pigment, "{text}");
        let content = &report["leaves"][0]["contents"][of.key()];
        for key in ["value", "standard_error", "interval_95"] {
            assert_eq!(content[key].is_null(), is_pigment, "{content}");
        }
        assert_eq!(content["reason"].is_string(), is_pigment, "{content}");
    }
    assert!(human(&fitted, free).contains("not determined"));
}

#[test]
fn covariances_are_written_for_each_pair_of_what_is_determined() {
    let leaf = leaf((0..61).map(|i| 1300.0 + 20.0 * f64::from(i)));
    let (leaves, question) = ([leaf], of_prospect_d());
    let free = &question.free;
    let fitted = question.answers(&leaves).expect("within the table");
    let report: Json =
        serde_json::from_str(&report(&unknown(), &fitted, free, Model::ProspectD)).expect("JSON");
    let covariance = &report["leaves"][0]["covariance"];
    let keys = ["structure", "water_cm", "dry_matter_g_per_cm2"];
    assert_eq!(covariance["of"], json!(keys));
    let text = covariances(&fitted);
    let mut rows = text.lines().skip(1);
    for (i, first) in keys.iter().enumerate() {
        for (j, second) in keys.iter().enumerate() {
            let row: Vec<&str> = rows.next().expect("nine rows").split(',').collect();
            assert_eq!(row[..3], ["l3", first, second]);
            let value = covariance["rows"][i][j].as_f64().expect("a number");
            assert_eq!(row[3].parse(), Ok(value));
            let correlation: f64 = row[4].parse().expect("a number");
            assert!(correlation.abs() <= 1.0 + 1e-9);
            assert!(i != j || (correlation - 1.0).abs() < 1e-12, "{text}");
        }
    }
    assert_eq!(rows.next(), None);
}
