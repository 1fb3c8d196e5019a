//! PROSPECT-D against figures computed independently (33 sets of contents × 211 wavelengths).

use leafmodel::document::declared::Words;
use leafmodel::optics::presets::{Preset, PresetBasis};
use leafmodel::optics::{Constituent, Contents, Model, Pigments, ProspectD, presets};
use renderer::image::tone::to_srgb;
use renderer::spectrum::cie;

const REFERENCE: &str = include_str!("data/prospect_d_reference.csv");
const CASES: usize = 33;
const WAVELENGTHS: usize = 211;

/// A row of the reference.
struct Row {
    case: &'static str,
    contents: Contents,
    wavelength_nm: f64,
    reflectance: f64,
    transmittance: f64,
}

fn rows() -> Vec<Row> {
    REFERENCE
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with("case,"))
        .map(|line| {
            let (case, figures) = line.split_once(',').expect("a row has a case");
            let figures: Vec<f64> = figures
                .split(',')
                .map(|figure| figure.parse().expect("a figure is a number"))
                .collect();
            let [n, cab, car, ant, brown, cw, cm] =
                figures[..7].try_into().expect("seven contents");
            Row {
                case,
                contents: Contents::new(n, cab, car, ant, brown, cw, cm)
                    .expect("the reference holds valid leaves"),
                wavelength_nm: figures[7],
                reflectance: figures[8],
                transmittance: figures[9],
            }
        })
        .collect()
}

#[test]
fn the_reference_is_whole() {
    assert_eq!(rows().len(), CASES * WAVELENGTHS);
}

#[test]
fn reflectance_and_transmittance_agree_with_the_reference_to_1e_9() {
    for row in rows() {
        let at =
            ProspectD::coefficients(row.wavelength_nm).expect("the wavelength is in the table");
        let leaf = at.reflectance_transmittance(&row.contents);
        let place = format!("{} at {} nm", row.case, row.wavelength_nm);
        let (r, t) = (leaf.reflectance, leaf.transmittance);
        assert!((r - row.reflectance).abs() < 1e-9, "{place}: R = {r}");
        assert!((t - row.transmittance).abs() < 1e-9, "{place}: T = {t}");
    }
}

/// Rows of another program: its model, and what the row has by column.
const MODELS: &str = include_str!("data/prospect_models_reference.csv");

#[test]
fn prospect_pro_5_and_4_agree_with_another_program() {
    let contents = [
        Constituent::Structure,
        Constituent::Chlorophyll,
        Constituent::Carotenoids,
        Constituent::Anthocyanins,
        Constituent::Brown,
        Constituent::Water,
        Constituent::DryMatter,
        Constituent::Proteins,
        Constituent::CarbonBased,
    ];
    let mut worst = [0.0_f64; 3];
    let rows = MODELS.lines().skip(2);
    assert_eq!(rows.clone().count(), 3 * 12 * 29);
    for row in rows {
        let (model, figures) = row.split_once(',').expect("a row has a model");
        let figures: Vec<f64> = figures
            .split(',')
            .map(|figure| figure.parse().expect("a figure is a number"))
            .collect();
        let mut leaf = Contents::NOTHING;
        for (of, value) in contents.into_iter().zip(&figures) {
            leaf[of] = *value;
        }
        let number = Model::WORDS
            .iter()
            .skip(1)
            .position(|(name, _)| *name == model);
        let number = number.expect("it is one of three");
        let model = Model::WORDS[number + 1].1;
        assert_eq!(model.refusal(&leaf), None, "{row}");
        let pigments = Pigments {
            model,
            ..Pigments::default()
        };
        let [nm, r, t] = figures[contents.len()..] else {
            panic!("a row ends with the wavelength, R and T");
        };
        let at = ProspectD::coefficients_of(&pigments, nm);
        let found = at.reflectance_transmittance(&leaf);
        let off = (found.reflectance - r)
            .abs()
            .max((found.transmittance - t).abs());
        worst[number] = worst[number].max(off);
    }
    eprintln!("greatest difference of PROSPECT-PRO, -5, -4: {worst:?}");
    // Its table of PROSPECT-5 is rounded to single precision.
    for (off, allowed) in worst.into_iter().zip([1e-9, 1e-7, 1e-7]) {
        assert!(off < allowed, "{worst:?}");
    }
}

/// The book's page on pigments.
const PAGE: &str = include_str!("../docs/src/theory/pigments.md");

#[test]
fn the_book_lists_every_figure_behind_the_pigments() {
    let figures = Pigments::figures();
    let rows: Vec<String> = figures
        .iter()
        .map(|figure| {
            format!(
                "| {} | {} | {} | {} | {} |",
                figure.of,
                figure.value,
                figure.unit,
                figure.basis.word(),
                figure.source
            )
        })
        .collect();
    let missing: Vec<&String> = rows.iter().filter(|row| !PAGE.contains(*row)).collect();
    assert!(missing.is_empty(), "not in the book:\n{missing:#?}");
    let listed = PAGE
        .split("## Every figure")
        .nth(1)
        .expect("the page has the list");
    assert_eq!(
        listed.lines().filter(|line| line.starts_with("| ")).count(),
        rows.len() + 2,
        "rows of the table, its head and the rule below it"
    );
}

/// sRGB under D65 of a share of the light, as web pages write it.
fn hex(share: impl Fn(f64) -> f64) -> String {
    let rgb = cie::srgb_from_xyz(cie::xyz_under_d65(share));
    let [r, g, b] = rgb.map(|light| (255.0 * to_srgb(light.clamp(0.0, 1.0))).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// What the numbers of a preset that are not 0 rest on, in words. That N is fitted where contents
/// are measured is said below the table.
fn rests_on(preset: &Preset) -> String {
    let usual = |constituent: Constituent, basis: PresetBasis| {
        basis == preset.basis
            || basis == PresetBasis::Absent
            || (constituent == Constituent::Structure
                && preset.basis == PresetBasis::Measured
                && basis == PresetBasis::Fitted)
    };
    let all = Constituent::ALL.map(|constituent| (constituent, preset.basis_of(constituent)));
    let unusual = |&(constituent, basis): &(Constituent, PresetBasis)| !usual(constituent, basis);
    let others: Vec<(Constituent, PresetBasis)> = all.into_iter().filter(unusual).collect();
    let Some(&(_, basis)) = others.first() else {
        return preset.basis.word().to_owned();
    };
    assert!(others.iter().all(|other| other.1 == basis), "{others:?}");
    let names: Vec<&str> = others.iter().map(|other| other.0.symbol()).collect();
    let names = names.join(", ");
    format!("{names} {}; the rest {}", basis.word(), preset.basis.word())
}

#[test]
fn the_book_lists_the_presets_as_they_are() {
    let listed: Vec<&str> = PAGE
        .lines()
        .skip_while(|line| !line.starts_with("| preset |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .collect();
    let rows = presets::ALL.map(|preset| {
        let c = preset.contents;
        let optics = |nm| ProspectD::coefficients_extrapolated(nm).reflectance_transmittance(&c);
        format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | `{}` | `{}` | {} |",
            preset.name,
            c[Constituent::Structure],
            c[Constituent::Chlorophyll],
            c[Constituent::Carotenoids],
            c[Constituent::Anthocyanins],
            c[Constituent::Brown],
            c[Constituent::Water],
            c[Constituent::DryMatter],
            hex(|nm| optics(nm).reflectance),
            hex(|nm| optics(nm).transmittance),
            rests_on(&preset)
        )
    });
    assert_eq!(listed, rows);
}
