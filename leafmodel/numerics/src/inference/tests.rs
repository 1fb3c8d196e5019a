//! Fits of models whose posterior is known in closed form.

use std::convert::Infallible;

use super::random::{normal, uniform};
use super::*;
use crate::random::Use;

/// Carries out a simulator of parameters and standard normal numbers.
fn simulated(
    simulator: impl Fn(&[f64], &[f64]) -> Vec<f64>,
) -> impl FnMut(&[Draw]) -> Result<Vec<Outcome>, Infallible> {
    move |draws| {
        let one = |draw: &Draw| {
            let chance = normal(draw.seed, 0, 0, 8);
            Ok(simulator(&draw.values, &chance)
                .into_iter()
                .map(Some)
                .collect())
        };
        Ok(draws.iter().map(one).collect())
    }
}

fn problem(ranges: &[(&str, f64, f64)], observed: &[f64], count: usize, seed: u64) -> Problem {
    let parameters = ranges
        .iter()
        .map(|(name, low, high)| Parameter::new(*name, *low, *high).expect("a range"));
    let numbered = observed.iter().enumerate();
    let observed = numbered.map(|(i, value)| Observation {
        key: format!("x{i}"),
        value: *value,
        role: Role::Fitted,
    });
    Problem::new(parameters.collect(), observed.collect(), count, seed).expect("a problem")
}

#[test]
fn a_gaussian_posterior_has_its_mean_deviation_and_correlation() {
    // Two readings of a, one of a + b, each with an error of 0.1. The prior is flat and far wider,
    // so the posterior is normal with the mean and the covariance of least squares.
    let simulator = |v: &[f64], e: &[f64]| {
        let (a, b) = (v[0], v[1]);
        vec![a + 0.1 * e[0], a + 0.1 * e[1], a + b + 0.1 * e[2]]
    };
    let ranges = [("a", -3.0, 3.0), ("b", -3.0, 3.0)];
    let deviations = [0.1 * 0.5_f64.sqrt(), 0.1 * 1.5_f64.sqrt()];
    for seed in 0..6 {
        let problem = problem(&ranges, &[1.02, 0.94, 1.7], 1000, seed);
        let found = fit(&problem, simulated(simulator)).expect("a fit");
        // The sample is worth some 180 draws: standard errors are 1/√180 = 0.075 of a deviation
        // for the mean, 1/√360 = 0.053 for the deviation, (1 − ρ²)/√180 = 0.05 for ρ. What the
        // regression has wrong in its coefficients adds about as much. Bounds are 4 of the sum.
        assert!(found.effective_size > 100.0, "{}", found.effective_size);
        for ((told, mean), deviation) in found.parameters.iter().zip([0.98, 0.72]).zip(deviations) {
            let off = (told.mean - mean) / deviation;
            assert!(
                off.abs() < 0.4,
                "seed {seed}: {off} deviations off: {told:?}"
            );
            let ratio = told.deviation / deviation;
            assert!((0.75..1.3).contains(&ratio), "seed {seed}: {ratio}");
        }
        let correlation = found.correlations[0].value;
        assert!(
            (correlation + 3.0_f64.sqrt().recip()).abs() < 0.25,
            "{correlation}"
        );
    }
}

#[test]
fn a_parameter_without_influence_keeps_its_prior() {
    let simulator = |v: &[f64], e: &[f64]| vec![v[0] + 0.1 * e[0], e[1]];
    let ranges = [("known", -3.0, 3.0), ("idle", 1.0, 100.0)];
    for seed in 0..4 {
        let problem = problem(&ranges, &[0.5, 0.3], 1000, seed);
        let found = fit(&problem, simulated(simulator)).expect("a fit");
        let [known, idle] = [&found.parameters[0], &found.parameters[1]];
        assert_eq!(known.identified(), Identified::Well);
        assert_eq!(idle.identified(), Identified::No);
        assert!(idle.contraction.abs() < 0.3, "{idle:?}");
        // Equal ratios were equally likely: the median is 10 by a factor of 100 to the power of
        // the standard error of a uniform median, 0.5/√180, four times: 2.
        assert!((5.0..20.0).contains(&idle.median), "{idle:?}");
        assert!(
            idle.sentence().contains("do not tell idle"),
            "{}",
            idle.sentence()
        );
        assert!(found.correlations[0].value.abs() < 0.4);
    }
}

#[test]
fn of_two_parameters_whose_product_matters_neither_is_reported() {
    let simulator = |v: &[f64], e: &[f64]| vec![v[0] * v[1] * libm::exp(0.05 * e[0])];
    let ranges = [("width", 0.1, 10.0), ("length", 0.1, 10.0)];
    let problem = problem(&ranges, &[1.0], 1500, 3);
    let found = fit(&problem, simulated(simulator)).expect("a fit");
    for told in &found.parameters {
        assert_eq!(told.identified(), Identified::No, "{told:?}");
    }
    let correlation = &found.correlations[0];
    assert!(correlation.value < -0.95, "{correlation:?}");
    let sentence = correlation.sentence().expect("a strong correlation");
    assert!(sentence.contains("a product"), "{sentence}");
    // Their product is: the posterior's logarithm has a deviation of 0.05.
    let logarithm = |values: &[f64]| libm::log(values[0] * values[1]);
    let weighted = found.sample.iter().map(|(v, w)| (logarithm(v), w));
    let mean: f64 = weighted.clone().map(|(x, w)| w * x).sum();
    let variance: f64 = weighted.map(|(x, w)| w * (x - mean) * (x - mean)).sum();
    assert!(mean.abs() < 0.03, "{mean}");
    assert!(
        (0.03..0.08).contains(&variance.sqrt()),
        "{}",
        variance.sqrt()
    );
}

#[test]
fn no_value_leaves_its_range_and_whole_numbers_stay_whole() {
    // The truth lies at an end of each range; a count is read with an error of a third.
    let simulator = |v: &[f64], e: &[f64]| vec![v[0] + 0.2 * e[0], v[1] + 0.3 * e[1]];
    let parameters = vec![
        Parameter::new("a", 0.0, 1.0).expect("a range"),
        Parameter::new("n", 1.0, 6.0).expect("a range").whole(),
    ];
    let observed = [("x", 1.1, Role::Fitted), ("y", 2.1, Role::Fitted)];
    let observed = observed.map(Observation::from).to_vec();
    let problem = Problem::new(parameters, observed, 1000, 1).expect("a problem");
    let found = fit(&problem, |draws| {
        for draw in draws {
            assert!((0.0..=1.0).contains(&draw.values[0]), "{draw:?}");
            assert!((1.0..=6.0).contains(&draw.values[1]), "{draw:?}");
            assert_eq!(draw.values[1].fract(), 0.0);
        }
        simulated(simulator)(draws)
    });
    let found = found.expect("a fit");
    for (values, weight) in &found.sample {
        assert!((0.0..=1.0).contains(&values[0]) && *weight > 0.0);
        assert_eq!(values[1].fract(), 0.0);
    }
    let [a, n] = [&found.parameters[0], &found.parameters[1]];
    // A normal distribution around 1.1 with 0.2 that is cut at 0 and 1 has the mean 0.838.
    assert!((a.mean - 0.838).abs() < 0.05, "{a:?}");
    assert_eq!(n.median, 2.0);
    assert_eq!(n.intervals[0], [2.0, 2.0], "{n:?}");
}

/// A model with many measures, curved in its parameters, of unequal noise and alike.
fn curved(v: &[f64], e: &[f64]) -> Vec<f64> {
    let (a, b) = (libm::log(v[0]), v[1]);
    vec![
        v[0] * libm::exp(0.1 * e[0]),
        a * b + 0.2 * e[1],
        b * b + (0.2 + 0.1 * b) * e[2],
        libm::exp(0.5 * a + 0.1 * e[0] + 0.05 * e[3]),
        a + b + 0.3 * e[4],
        e[5],
        7.0,
    ]
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let ranges = [("a", 0.5, 8.0), ("b", 0.0, 3.0)];
    let (mut half, mut most, fits) = (0, 0, 60);
    for number in 0..fits {
        let share = |dimension| uniform(99, Use::Prior, 0, number, dimension);
        let truth = [0.5 * libm::pow(16.0, share(0)), 3.0 * share(1)];
        let observed = curved(&truth, &normal(1234, 0, number, 8));
        let problem = problem(&ranges, &observed, 500, u64::from(number));
        let found = fit(&problem, simulated(curved)).expect("a fit");
        assert_eq!(found.constant, [("x6".to_owned(), true)]);
        for (told, truth) in found.parameters.iter().zip(truth) {
            let holds = |[low, high]: [f64; 2]| u32::from((low..=high).contains(&truth));
            half += holds(told.intervals[0]);
            most += holds(told.intervals[1]);
        }
    }
    // Of 120: a binomial distribution with p = 1/2 has 60 ± 5.5, one with 0.9 has 108 ± 3.3. Both
    // bounds are at three deviations.
    assert!((44..=76).contains(&half), "{half} of 120 within 50 %");
    assert!((98..=117).contains(&most), "{most} of 120 within 90 %");
}

#[test]
fn what_fails_or_lacks_a_measure_is_counted_and_left_out() {
    let ranges = [("a", -1.0, 1.0)];
    let mut problem = problem(&ranges, &[0.5], 600, 5);
    problem
        .observed
        .push(Observation::from(("y", 0.5, Role::HeldOut)));
    let simulate = |draws: &[Draw]| {
        let one = |draw: &Draw| {
            let (a, noise) = (draw.values[0], normal(draw.seed, 0, 0, 2));
            if a < -0.5 {
                return Err("too small".to_owned());
            }
            let fitted = (a >= 0.0).then_some(a + 0.05 * noise[0]);
            // What is no number counts as missing.
            let other = if noise[1] > 1.0 { f64::NAN } else { a };
            Ok(vec![fitted, Some(other)])
        };
        Ok::<_, Infallible>(draws.iter().map(one).collect())
    };
    let found = fit(&problem, simulate).expect("a fit");
    assert!((20..100).contains(&found.failed), "{}", found.failed);
    assert_eq!(found.first_failure.as_deref(), Some("too small"));
    let keys: Vec<&str> = found.missing.iter().map(|(key, _)| key.as_str()).collect();
    assert_eq!(keys, ["x0", "y"]);
    assert!((found.parameters[0].median - 0.5).abs() < 0.03);
    let foretold = &found.predictions[1];
    assert_eq!(foretold.is_within(), Some(true), "{foretold:?}");
    assert!(foretold.count < 60 && foretold.count > 40, "{foretold:?}");
}

#[test]
fn a_fit_that_is_impossible_says_why() {
    let problem = problem(&[("a", 0.0, 1.0)], &[0.5], 300, 1);
    let constant = |draws: &[Draw]| -> Result<Vec<Outcome>, &str> {
        Ok(draws.iter().map(|_| Ok(vec![Some(0.5)])).collect())
    };
    assert!(matches!(
        fit(&problem, constant),
        Err(FitError::NothingVaries)
    ));
    let failing = |draws: &[Draw]| -> Result<Vec<Outcome>, &str> {
        Ok(draws.iter().map(|_| Err("no veins".to_owned())).collect())
    };
    let error = fit(&problem, failing).expect_err("nothing to compare");
    let text = error.to_string();
    assert!(
        text.contains("0 of 82 simulations can be compared"),
        "{text}"
    );
    assert!(text.contains("82 failed (the first: no veins)"), "{text}");
    let missing = |draws: &[Draw]| -> Result<Vec<Outcome>, &str> {
        Ok(draws.iter().map(|_| Ok(vec![None])).collect())
    };
    let text = fit(&problem, missing).expect_err("nothing").to_string();
    assert!(text.contains("`x0` is missing in 82"), "{text}");
    let stopped = |_: &[Draw]| Err("enough");
    assert!(matches!(
        fit(&problem, stopped),
        Err(FitError::Stopped("enough"))
    ));
}

#[test]
fn what_the_ranges_cannot_reach_is_reported() {
    let simulator = |v: &[f64], e: &[f64]| vec![v[0] + 0.05 * e[0]];
    let problem = problem(&[("a", 0.0, 1.0)], &[3.0], 500, 1);
    let found = fit(&problem, simulated(simulator)).expect("a fit");
    let a = &found.parameters[0];
    assert_eq!(a.beyond, Some(Beyond::High));
    assert!(a.median > 0.95 && a.median <= 1.0, "{a:?}");
    assert_eq!(found.predictions[0].is_within(), Some(false));
}

#[test]
fn the_same_problem_has_the_same_fit_and_another_seed_another() {
    let simulator = |v: &[f64], e: &[f64]| vec![v[0] + 0.1 * e[0]];
    let fit_of = |seed| {
        let problem = problem(&[("a", -1.0, 1.0)], &[0.2], 300, seed);
        fit(&problem, simulated(simulator)).expect("a fit")
    };
    assert_eq!(fit_of(1), fit_of(1));
    assert_ne!(fit_of(1).sample, fit_of(2).sample);
}

#[test]
fn problems_that_are_none_are_refused() {
    let range = |name: &str| Parameter::new(name, 0.0, 1.0).expect("a range");
    let seen = |value| vec![Observation::from(("x", value, Role::Fitted))];
    let refused = |parameters, observed, count| {
        Problem::new(parameters, observed, count, 1).expect_err("not a problem")
    };
    assert_eq!(refused(vec![], seen(1.0), 300), BadProblem::NothingFree);
    let held = vec![Observation::from(("x", 1.0, Role::HeldOut))];
    assert_eq!(
        refused(vec![range("a")], held, 300),
        BadProblem::NothingFitted
    );
    let twice = refused(vec![range("a"), range("a")], seen(1.0), 300);
    assert_eq!(twice.to_string(), "a is there twice");
    let nan = refused(vec![range("a")], seen(f64::NAN), 300);
    assert_eq!(nan.to_string(), "x is NaN, not a finite number");
    let few = refused(vec![range("a")], seen(1.0), 0);
    assert_eq!(few, BadProblem::TooFew(0));
}
