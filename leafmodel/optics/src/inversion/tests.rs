use super::*;
use crate::faces::abaxial_ratio;
use crate::layers::{LayeredLeaf, Resolution};
use crate::{Model, Pigments};
use document::declared::Words;
use properties::uniform;

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
        let inversion = Inversion::new(
            &Pigments::default(),
            &self.nm,
            Model::ProspectD.inputs(),
            Contents::NOTHING,
        )
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
        let inversion = Inversion::new(
            &Pigments::default(),
            &self.nm,
            Model::ProspectD.inputs(),
            Contents::NOTHING,
        )
        .expect("within the table");
        inversion.of(Spectra {
            reflectance: with[0].then_some(&self.reflectance),
            abaxial: Some(abaxial),
            transmittance: with[1].then_some(&self.transmittance),
        })
    }

    /// Greatest difference from the case's contents, over them or over a hundredth of what matters.
    fn worst(&self, found: &Found) -> (f64, Constituent) {
        let off = Model::ProspectD.inputs().iter().map(|&of| {
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
                assert!(!told.known.has_value(), "{}: {told:?}", case.name);
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
fn the_abaxial_face_and_light_that_passes_determine_the_contents_too() {
    let case = &cases()[0];
    let found = case.found_by_faces(&case.abaxial(0.5), [false, true]);
    assert!(case.worst(&found).0 < 0.01);
    let told = found.contrast.expect("that face was measured");
    assert!((told.value - 0.5).abs() < 5e-3, "{told:?}");
    assert!(found.reflectance_left.is_empty());
    assert_eq!(found.abaxial_left.len(), case.nm.len());
}

/// Normal numbers that follow from the seed alone, by Box and Muller's transform.
fn normals(seed: u64) -> impl FnMut() -> f64 {
    let mut counter = 0;
    move || {
        counter += 2;
        let [radius, turn] = [counter, counter + 1].map(|at| uniform(seed, 1, at));
        (-2.0 * libm::log(1.0 - radius)).sqrt() * libm::cos(std::f64::consts::TAU * turn)
    }
}

/// Intervals of 95 %, and how many of them hold the truth.
#[derive(Debug, Default)]
struct Coverage {
    inside: u32,
    all: u32,
}

impl Coverage {
    fn count(&mut self, value: f64, truth: f64, known: Determined) {
        if let Some(error) = known.error() {
            self.all += 1;
            self.inside += u32::from((value - truth).abs() < INTERVAL * error);
        }
    }

    fn count_all(&mut self, found: &Found, truth: &Contents) {
        for &of in Model::ProspectD.inputs() {
            self.count(found.contents[of], truth[of], found.known[of]);
        }
    }

    fn fraction(&self) -> f64 {
        f64::from(self.inside) / f64::from(self.all)
    }
}

#[test]
#[ignore = "deep: 4 s"]
fn intervals_hold_the_truth_as_often_as_they_say_under_noise_of_one_percent() {
    let mut normal = normals(5);
    let mut coverage = Coverage::default();
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
            coverage.count(contrast.value, 0.7, contrast.known);
            coverage.count_all(&both, &case.contents);
            coverage.count_all(&noisy.found([true, true]), &case.contents);
        }
    }
    // Some 1300 intervals of seven contents and the contrast in 132 leaves, by one face and by both;
    // four standard deviations of their number.
    let slack = 4.0 * (0.95 * 0.05 / f64::from(coverage.all)).sqrt();
    assert!((coverage.fraction() - 0.95).abs() < slack, "{coverage:?}");
}

/// Noise along a spectrum.
#[derive(Clone, Copy, Debug)]
enum Noise {
    /// Correlations fall as exp(−Δ / 10 nm).
    Exponential,
    /// Means of 10 nm.
    Boxes,
    /// Half of the first, half white.
    Mixed,
}

impl Noise {
    /// Noise of variance 1 at wavelengths in steps.
    fn drawn(self, count: usize, step_nm: f64, normal: &mut impl FnMut() -> f64) -> Vec<f64> {
        let exponential = |normal: &mut dyn FnMut() -> f64| -> Vec<f64> {
            let falls = libm::exp(-step_nm / 10.0);
            let rest = (1.0 - falls * falls).sqrt();
            let mut drawn = vec![normal()];
            while drawn.len() < count {
                drawn.push(falls * drawn[drawn.len() - 1] + rest * normal());
            }
            drawn
        };
        match self {
            Self::Exponential => exponential(normal),
            Self::Boxes => {
                let wide = (10.0 / step_nm) as usize;
                let white: Vec<f64> = (0..count + wide).map(|_| normal()).collect();
                let windows = white.windows(wide).take(count);
                windows
                    .map(|window| window.iter().sum::<f64>() / (wide as f64).sqrt())
                    .collect()
            }
            Self::Mixed => {
                let smooth = exponential(normal);
                let half = 0.5_f64.sqrt();
                smooth
                    .iter()
                    .map(|smooth| half * (smooth + normal()))
                    .collect()
            }
        }
    }
}

/// Coverage over so many leaves, whose noise is a fraction of the signal or the same everywhere.
fn covered(noise: Noise, step_nm: f64, last_nm: f64, is_relative: bool, leaves: usize) -> Coverage {
    let mut normal = normals(63);
    let count = ((last_nm - 400.0) / step_nm) as usize + 1;
    let nm: Vec<f64> = (0..count).map(|i| 400.0 + step_nm * i as f64).collect();
    let at = nm
        .iter()
        .map(|&nm| ProspectD::coefficients(nm).expect("within the table"));
    let at: Vec<Coefficients> = at.collect();
    let inversion = Inversion::new(
        &Pigments::default(),
        &nm,
        Model::ProspectD.inputs(),
        Contents::NOTHING,
    );
    let inversion = inversion.expect("within the table");
    let mut coverage = Coverage::default();
    for leaf in 0..leaves {
        let part = leaf as f64 / leaves as f64;
        let contents = Contents::prospect_d([
            1.4 + 0.6 * part,
            60.0 - 35.0 * part,
            12.0 - 4.0 * part,
            1.0 + 4.0 * part,
            0.1 + 0.2 * part,
            0.009 + 0.006 * part,
            0.005 + 0.004 * part,
        ]);
        let clean: Vec<_> = at
            .iter()
            .map(|at| at.reflectance_transmittance(&contents))
            .collect();
        let mut noisy = |clean: Vec<f64>| -> Vec<f64> {
            let noise = noise.drawn(count, step_nm, &mut normal);
            let size = |value: f64| if is_relative { 0.01 * value } else { 0.003 };
            clean
                .iter()
                .zip(noise)
                .map(|(value, noise)| value + size(*value) * noise)
                .collect()
        };
        let reflectance = noisy(clean.iter().map(|leaf| leaf.reflectance).collect());
        let transmittance = noisy(clean.iter().map(|leaf| leaf.transmittance).collect());
        let found = inversion.of(Spectra {
            reflectance: Some(&reflectance),
            transmittance: Some(&transmittance),
            ..Spectra::default()
        });
        assert!(found.correlation.is_some(), "{noise:?} is correlated");
        coverage.count_all(&found, &contents);
    }
    coverage
}

/// Without widening these intervals held the truth in 64 of 100 cases.
#[test]
fn intervals_hold_the_truth_under_noise_that_is_correlated_over_ten_nanometres() {
    let coverage = covered(Noise::Exponential, 5.0, 2500.0, true, 12);
    // Some 84 intervals, seven of a leaf together: three standard deviations of them.
    assert!(
        coverage.all > 70 && coverage.fraction() > 0.88,
        "{coverage:?}"
    );
}

#[test]
#[ignore = "deep: 40 s"]
fn intervals_hold_the_truth_under_correlated_noise_of_every_form() {
    let cases = [
        (Noise::Exponential, 1.0, 2500.0),
        (Noise::Boxes, 2.0, 2500.0),
        (Noise::Mixed, 2.0, 2500.0),
        (Noise::Exponential, 2.0, 1000.0),
    ];
    for (noise, step_nm, last_nm) in cases {
        let mut both = Coverage::default();
        for is_relative in [false, true] {
            let own = covered(noise, step_nm, last_nm, is_relative, 20);
            both.inside += own.inside;
            both.all += own.all;
        }
        // Some 280 intervals, seven of a leaf together.
        let fraction = both.fraction();
        eprintln!("{noise:?} in steps of {step_nm} nm to {last_nm} nm: {fraction:.3}");
        assert!((0.88..=0.98).contains(&fraction), "{noise:?}: {both:?}");
    }
}

#[test]
fn the_covariance_has_the_squares_of_the_errors_on_its_diagonal_and_is_symmetric() {
    let case = &cases()[0];
    let mut normal = normals(7);
    let noisy: Vec<f64> = case
        .reflectance
        .iter()
        .map(|value| value * (1.0 + 0.01 * normal()))
        .collect();
    let inversion = Inversion::new(
        &Pigments::default(),
        &case.nm,
        Model::ProspectD.inputs(),
        Contents::NOTHING,
    );
    let found = inversion.expect("within the table").of(Spectra {
        reflectance: Some(&noisy),
        ..Spectra::default()
    });
    let Covariance { of, rows } = &found.covariance;
    assert!(of.len() >= 6, "{of:?}");
    for (i, of) in of.iter().enumerate() {
        let error = found.known[of.expect("one face")]
            .error()
            .expect("it is determined");
        assert!((rows[i][i] - error * error).abs() <= 1e-12 * rows[i][i]);
        for j in 0..rows.len() {
            assert!((rows[i][j] - rows[j][i]).abs() <= 1e-9 * (rows[i][i] * rows[j][j]).sqrt());
            assert!(rows[i][j] * rows[i][j] <= rows[i][i] * rows[j][j] * (1.0 + 1e-9));
        }
    }
}

#[test]
fn pigments_have_no_value_where_only_infrared_light_was_measured() {
    let case = &cases()[0];
    let from = case
        .nm
        .iter()
        .position(|nm| *nm >= 1300.0)
        .expect("the table goes on");
    for betalains in [false, true] {
        let mut free = Model::ProspectD.inputs().to_vec();
        if betalains {
            free.push(Constituent::Betacyanins);
        }
        let inversion = Inversion::new(
            &Pigments::default(),
            &case.nm[from..],
            &free,
            Contents::NOTHING,
        );
        let found = inversion.expect("within the table").of(Spectra {
            reflectance: Some(&case.reflectance[from..]),
            transmittance: Some(&case.transmittance[from..]),
            ..Spectra::default()
        });
        for &of in &free {
            let is_pigment = !matches!(
                of,
                Constituent::Structure | Constituent::Water | Constituent::DryMatter
            );
            let known = found.known[of];
            assert_eq!(known.has_value(), !is_pigment, "{of:?}: {known:?}");
            assert_eq!(known.reason().is_some(), is_pigment, "{of:?}: {known:?}");
        }
    }
}

#[test]
fn what_is_fixed_stays_and_the_rest_is_found_around_it() {
    let case = &cases()[0];
    let fixed = case.contents;
    let free = [Constituent::Chlorophyll, Constituent::Water];
    let inversion =
        Inversion::new(&Pigments::default(), &case.nm, &free, fixed).expect("within the table");
    let found = inversion.of(Spectra {
        reflectance: Some(&case.reflectance),
        ..Spectra::default()
    });
    assert_eq!(
        found.contents[Constituent::DryMatter],
        fixed[Constituent::DryMatter]
    );
    assert_eq!(found.known[Constituent::DryMatter], Determined::Given);
    assert!(case.worst(&found).0 < 1e-4);
}

#[test]
fn visible_light_does_not_determine_water() {
    let case = &cases()[0];
    let visible = case.nm.iter().filter(|nm| **nm <= 700.0).count();
    let inversion = Inversion::new(
        &Pigments::default(),
        &case.nm[..visible],
        Model::ProspectD.inputs(),
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
    let known = found.known[Constituent::Water];
    assert!(known.error().is_none_or(|error| error > 0.01), "{known:?}");
}

#[test]
fn a_wavelength_outside_of_the_table_is_refused() {
    let outside = Inversion::new(
        &Pigments::default(),
        &[500.0, 350.0],
        Model::ProspectD.inputs(),
        Contents::NOTHING,
    );
    assert_eq!(outside.expect_err("350 nm").wavelength_nm, 350.0);
}

/// Contents that are found of leaves of another model, whose faces differ by their tissue and not
/// by the rule: what the rule costs. The book has the figures.
#[test]
fn both_faces_of_a_leaf_of_layers_show_its_pigments_and_contrast() {
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
        let inversion = Inversion::new(
            &Pigments::default(),
            &nm,
            Model::ProspectD.inputs(),
            Contents::NOTHING,
        )
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
            let inputs = Model::ProspectD.inputs().iter();
            let shown: Vec<f64> = inputs.map(|&of| found.contents[of]).collect();
            eprintln!("{name}: {shown:.4?}, rms {:.4}", found.rms());
        }
        eprintln!("{contrast:?}");
        assert!(contrast.value > least, "{contrast:?}");
        let moved =
            both.contents[Constituent::Chlorophyll] / one.contents[Constituent::Chlorophyll];
        assert!((moved - 1.0).abs() < 0.25, "{moved}");
    }
}

/// R and T of a leaf in a model every 10 nm, with a ripple as of a model that lacks something.
fn spectra_of(pigments: &Pigments, leaf: &Contents, ripple: f64) -> [Vec<f64>; 3] {
    let nm: Vec<f64> = (0..211).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
    let optics = nm.iter().map(|&nm| {
        let leaf = ProspectD::coefficients_of(pigments, nm).reflectance_transmittance(leaf);
        let wave = ripple * libm::sin(nm / 60.0);
        (leaf.reflectance + wave, leaf.transmittance + wave)
    });
    let (r, t) = optics.unzip();
    [nm, r, t]
}

#[test]
fn contents_come_back_in_each_model() {
    let usual = Contents::of(&[
        (Constituent::Structure, 1.6),
        (Constituent::Chlorophyll, 42.0),
        (Constituent::Carotenoids, 9.0),
        (Constituent::Anthocyanins, 2.0),
        (Constituent::Brown, 0.1),
        (Constituent::Water, 0.012),
        (Constituent::DryMatter, 0.005),
        (Constituent::Proteins, 0.0012),
        (Constituent::CarbonBased, 0.005),
    ]);
    for (name, model) in Model::WORDS {
        let pigments = Pigments {
            model: *model,
            ..Pigments::default()
        };
        let mut leaf = Contents::NOTHING;
        for &of in model.inputs() {
            leaf[of] = usual[of];
        }
        let [nm, r, t] = spectra_of(&pigments, &leaf, 0.0);
        let inversion = Inversion::new(&pigments, &nm, model.inputs(), Contents::NOTHING);
        let found = inversion.expect("within the tables").of(Spectra {
            reflectance: Some(&r),
            transmittance: Some(&t),
            ..Spectra::default()
        });
        for &of in model.inputs() {
            let off = (found.contents[of] / leaf[of] - 1.0).abs();
            assert!(off < 1e-5, "{name}, {of:?}: {}", found.contents[of]);
        }
    }
}

#[test]
fn a_prior_decides_what_the_spectra_do_not_and_no_more() {
    let leaf = Contents::prospect_d([1.6, 42.0, 9.0, 1.0, 0.1, 0.012, 0.006]);
    let [nm, r, t] = spectra_of(&Pigments::default(), &leaf, 0.003);
    let visible = nm.partition_point(|nm| *nm <= 700.0);
    let priors = |prior| {
        PerConstituent::splat(None).with(&[
            (
                Constituent::Water,
                Some(Prior::Normal {
                    mean: 0.02,
                    deviation: 0.004,
                }),
            ),
            (Constituent::Chlorophyll, prior),
        ])
    };
    let found = |until: usize, prior| {
        let free = Model::ProspectD.inputs();
        let inversion = Inversion::new(&Pigments::default(), &nm[..until], free, Contents::NOTHING);
        let inversion = inversion
            .expect("within the tables")
            .with_priors(priors(prior));
        inversion.of(Spectra {
            reflectance: Some(&r[..until]),
            transmittance: Some(&t[..until]),
            ..Spectra::default()
        })
    };
    // Visible light does not determine water: there the prior is all that is known.
    let dim = found(visible, None);
    let water = dim.contents[Constituent::Water];
    let error = dim.known[Constituent::Water].error().expect("it is known");
    assert!((water - 0.02).abs() < 4e-4, "{water}");
    assert!((error / 0.004 - 1.0).abs() < 0.02, "{error}");
    // Infrared light determines it, whatever the prior.
    let bright = found(nm.len(), None);
    let water = bright.contents[Constituent::Water];
    assert!((water - 0.012).abs() < 1e-3, "{water}");
    // Between two sources that disagree the result lies by their weights.
    let alone = bright.contents[Constituent::Chlorophyll];
    let error = bright.known[Constituent::Chlorophyll]
        .error()
        .expect("it is known");
    let prior = Prior::Normal {
        mean: alone + 2.0 * error,
        deviation: error,
    };
    let both = found(nm.len(), Some(prior));
    let share = (both.contents[Constituent::Chlorophyll] - alone) / (2.0 * error);
    assert!((0.2..0.8).contains(&share), "{share}");
    let narrower = both.known[Constituent::Chlorophyll]
        .error()
        .expect("it is known");
    assert!(narrower < 0.85 * error, "{narrower} {error}");
    // A range is kept.
    let ranged = found(nm.len(), Some(Prior::Within([45.0, 60.0])));
    assert_eq!(ranged.contents[Constituent::Chlorophyll], 45.0);
    assert_eq!(ranged.known[Constituent::Chlorophyll], Determined::AtEnd);
}
