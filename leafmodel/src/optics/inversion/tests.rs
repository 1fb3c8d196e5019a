use super::*;
use crate::optics::layers::{LayeredLeaf, Resolution};
use crate::shape::chance::{bits, share};

/// The cases of the reference table: contents, and spectra that another implementation computed.
struct Case {
    name: String,
    contents: Contents,
    nm: Vec<f64>,
    reflectance: Vec<f64>,
    transmittance: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let text = include_str!("../../../fixtures/prospect_d_reference.csv");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let mut cases: Vec<Case> = Vec::new();
    for row in rows {
        let fields: Vec<&str> = row.split(',').collect();
        let numbers: Vec<f64> = fields[1..]
            .iter()
            .map(|field| field.parse().expect("a number"))
            .collect();
        if cases.last().is_none_or(|case| case.name != fields[0]) {
            let inputs = std::array::from_fn(|i| numbers[i]);
            cases.push(Case {
                name: fields[0].to_owned(),
                contents: Contents::prospect_d(inputs),
                nm: Vec::new(),
                reflectance: Vec::new(),
                transmittance: Vec::new(),
            });
        }
        let case = cases.last_mut().expect("one was pushed");
        case.nm.push(numbers[7]);
        case.reflectance.push(numbers[8]);
        case.transmittance.push(numbers[9]);
    }
    assert_eq!(cases.len(), 33);
    cases
}

impl Case {
    fn found(&self, with: [bool; 2]) -> Found {
        let inversion = Inversion::new(&self.nm, &Inversion::PROSPECT_D, Contents::NOTHING)
            .expect("within the table");
        inversion.of(Spectra {
            reflectance: with[0].then_some(&self.reflectance),
            transmittance: with[1].then_some(&self.transmittance),
            ..Spectra::default()
        })
    }

    /// Reflectances of the other face, by the rule with this contrast.
    fn abaxial(&self, contrast: f64) -> Vec<f64> {
        let faces = self.reflectance.iter().zip(&self.transmittance);
        let abaxial = faces.map(|(r, t)| r * abaxial_ratio(1.0 - r - t, contrast));
        abaxial.collect()
    }

    fn found_by_faces(&self, abaxial: &[f64], with: [bool; 2]) -> Found {
        let inversion = Inversion::new(&self.nm, &Inversion::PROSPECT_D, Contents::NOTHING)
            .expect("within the table");
        inversion.of(Spectra {
            reflectance: with[0].then_some(&self.reflectance),
            abaxial: Some(abaxial),
            transmittance: with[1].then_some(&self.transmittance),
        })
    }

    /// Greatest difference from the case's contents, over them or over a hundredth of what matters.
    fn worst(&self, found: &Found) -> (f64, Constituent) {
        let off = Inversion::PROSPECT_D.map(|of| {
            let least = 0.01 * parameter(of).scale;
            let off = (found.contents[of] - self.contents[of]).abs();
            (off / self.contents[of].abs().max(least), of)
        });
        off.into_iter()
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .expect("seven of them")
    }
}

#[test]
fn contents_come_back_from_clean_spectra_of_both_or_of_one_kind() {
    for case in cases() {
        for with in [[true, true], [true, false], [false, true]] {
            let found = case.found(with);
            let (off, of) = case.worst(&found);
            assert!(
                off < 0.01,
                "{} by {with:?}: {of:?} is off by {off}",
                case.name
            );
            assert!(found.rms() < 1e-6, "{}: {}", case.name, found.rms());
            let values = case.nm.len() * with.into_iter().filter(|with| *with).count();
            assert_eq!(found.values(), values);
        }
    }
}

#[test]
fn contents_and_contrast_come_back_from_clean_spectra_of_both_faces() {
    for case in cases() {
        for (contrast, with) in [
            (0.7, [true, true]),
            (-0.4, [true, true]),
            (1.3, [true, false]),
        ] {
            let abaxial = case.abaxial(contrast);
            let found = case.found_by_faces(&abaxial, with);
            let (off, of) = case.worst(&found);
            assert!(
                off < 0.01,
                "{} {contrast}: {of:?} is off by {off}",
                case.name
            );
            let told = found.contrast.expect("both faces were measured");
            let shares = case.reflectance.iter().zip(&case.transmittance);
            let is_clear = shares.into_iter().all(|(r, t)| r + t > 1.0 - 1e-6);
            if is_clear {
                // Faces of what absorbs nothing are alike, whatever the contrast.
                assert_eq!(told.error, None, "{}", case.name);
            } else {
                let off = (told.value - contrast).abs();
                assert!(off < 0.01 * contrast.abs(), "{}: {told:?}", case.name);
            }
            assert!(found.rms() < 1e-6, "{}: {}", case.name, found.rms());
            let spectra = 2 + usize::from(with[1]);
            assert_eq!(found.values(), spectra * case.nm.len());
        }
    }
}

#[test]
fn the_abaxial_face_and_light_that_passes_tell_the_contents_too() {
    let case = &cases()[0];
    let found = case.found_by_faces(&case.abaxial(0.5), [false, true]);
    assert!(case.worst(&found).0 < 0.01);
    let told = found.contrast.expect("that face was measured");
    assert!((told.value - 0.5).abs() < 5e-3, "{told:?}");
    assert!(found.reflectance_left.is_empty());
    assert_eq!(found.abaxial_left.len(), case.nm.len());
}

#[test]
#[ignore = "deep: 4 s"]
fn intervals_hold_the_truth_as_often_as_they_say_under_noise_of_one_percent() {
    let mut counter = 0;
    // Box and Muller's transform.
    let mut normal = || {
        counter += 2;
        let [radius, turn] = [counter, counter + 1].map(|at| share(bits(5, 1, at)));
        (-2.0 * libm::log(1.0 - radius)).sqrt() * libm::cos(std::f64::consts::TAU * turn)
    };
    let (mut inside, mut told) = (0, 0);
    for case in cases() {
        for _ in 0..4 {
            let mut noisy = |clean: &[f64]| -> Vec<f64> {
                let noise = clean.iter().map(|value| value * (1.0 + 0.01 * normal()));
                noise.collect()
            };
            let noisy = Case {
                name: case.name.clone(),
                contents: case.contents,
                nm: case.nm.clone(),
                reflectance: noisy(&case.reflectance),
                transmittance: noisy(&case.transmittance),
            };
            let abaxial: Vec<f64> = case
                .abaxial(0.7)
                .iter()
                .map(|value| value * (1.0 + 0.01 * normal()))
                .collect();
            let both = noisy.found_by_faces(&abaxial, [true, true]);
            let contrast = both.contrast.expect("both faces were measured");
            if let Some(error) = contrast.error {
                told += 1;
                inside += usize::from((contrast.value - 0.7).abs() < 1.96 * error);
            }
            let found = noisy.found([true, true]);
            let of_both = Inversion::PROSPECT_D.map(|of| (both.contents[of], both.errors[of], of));
            for (value, error, of) in of_both {
                if let Some(error) = error {
                    told += 1;
                    inside += usize::from((value - case.contents[of]).abs() < 1.96 * error);
                }
            }
            for of in Inversion::PROSPECT_D {
                if let Some(error) = found.errors[of] {
                    told += 1;
                    let off = (found.contents[of] - case.contents[of]).abs();
                    inside += usize::from(off < 1.96 * error);
                }
            }
        }
    }
    // Some 1300 intervals of seven contents and the contrast in 132 leaves, by one face and by both;
    // four standard deviations of their number.
    let share = inside as f64 / f64::from(told);
    let slack = 4.0 * (0.95 * 0.05 / f64::from(told)).sqrt();
    assert!((share - 0.95).abs() < slack, "{inside} of {told}");
}

#[test]
fn what_is_fixed_stays_and_the_rest_is_found_around_it() {
    let case = &cases()[0];
    let fixed = case.contents;
    let free = [Constituent::Chlorophyll, Constituent::Water];
    let inversion = Inversion::new(&case.nm, &free, fixed).expect("within the table");
    let found = inversion.of(Spectra {
        reflectance: Some(&case.reflectance),
        ..Spectra::default()
    });
    assert_eq!(
        found.contents[Constituent::DryMatter],
        fixed[Constituent::DryMatter]
    );
    assert_eq!(found.errors[Constituent::DryMatter], None);
    assert!(case.worst(&found).0 < 1e-4);
}

#[test]
fn water_is_not_told_by_visible_light() {
    let case = &cases()[0];
    let visible = case.nm.iter().filter(|nm| **nm <= 700.0).count();
    let inversion = Inversion::new(
        &case.nm[..visible],
        &Inversion::PROSPECT_D,
        Contents::NOTHING,
    );
    // Off by one percent, to one side and the other.
    let off = |clean: &[f64]| -> Vec<f64> {
        let signs = [1.01, 0.99].into_iter().cycle();
        clean
            .iter()
            .zip(signs)
            .map(|(value, factor)| value * factor)
            .collect()
    };
    let reflectance = off(&case.reflectance[..visible]);
    let transmittance = off(&case.transmittance[..visible]);
    let found = inversion.expect("within the table").of(Spectra {
        reflectance: Some(&reflectance),
        transmittance: Some(&transmittance),
        ..Spectra::default()
    });
    assert!(found.contents[Constituent::Chlorophyll] > 0.0);
    let error = found.errors[Constituent::Water];
    assert!(error.is_none_or(|error| error > 0.01), "{error:?}");
}

#[test]
fn a_wavelength_outside_of_the_table_is_refused() {
    let outside = Inversion::new(&[500.0, 350.0], &Inversion::PROSPECT_D, Contents::NOTHING);
    assert_eq!(outside.expect_err("350 nm").wavelength_nm, 350.0);
}

/// Contents that are found of leaves of another model, whose faces differ by their tissue and not
/// by the rule: what the rule costs. The book has the figures.
#[test]
fn both_faces_of_a_leaf_of_layers_tell_its_pigments_and_contrast() {
    let nm: Vec<f64> = (0..106).map(|i| 400.0 + 20.0 * f64::from(i)).collect();
    for (chlorophyll, least) in [(15.0, 0.1), (40.0, 0.1)] {
        let contents = Contents::prospect_d([1.6, chlorophyll, 8.0, 1.0, 0.05, 0.012, 0.006]);
        let leaf = LayeredLeaf::new(&contents);
        let (mut faces, mut through) = ([Vec::new(), Vec::new()], Vec::new());
        for &nm in &nm {
            let at = ProspectD::coefficients(nm).expect("within the table");
            let [adaxial, abaxial] = leaf.faces(&at, Resolution::FAST).normal;
            faces[0].push(adaxial.reflected);
            faces[1].push(abaxial.reflected);
            through.push(adaxial.transmitted);
        }
        let inversion = Inversion::new(&nm, &Inversion::PROSPECT_D, Contents::NOTHING)
            .expect("within the table");
        let [one, both] = [None, Some(faces[1].as_slice())].map(|abaxial| {
            inversion.of(Spectra {
                reflectance: Some(&faces[0]),
                abaxial,
                transmittance: Some(&through),
            })
        });
        let contrast = both.contrast.expect("both faces are there");
        for (name, found) in [("one face", &one), ("both", &both)] {
            let shown = Inversion::PROSPECT_D.map(|of| found.contents[of]);
            eprintln!("{name}: {shown:.4?}, rms {:.4}", found.rms());
        }
        eprintln!("{contrast:?}");
        assert!(contrast.value > least, "{contrast:?}");
        let moved =
            both.contents[Constituent::Chlorophyll] / one.contents[Constituent::Chlorophyll];
        assert!((moved - 1.0).abs() < 0.25, "{moved}");
    }
}
