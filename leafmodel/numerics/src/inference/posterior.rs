//! What a weighted sample says of each parameter.

use super::linear::moments;
use super::prior::Parameter;
use super::problem::Problem;

/// Shares of the posterior within its intervals.
pub(super) const LEVELS: [f64; 3] = [0.5, 0.9, 0.95];

/// Share of the prior that a 95 % interval covers, from which on a parameter is told weakly.
const WEAKLY_FROM: f64 = 0.35;

/// The same from which on it is not told.
const NOT_FROM: f64 = 0.7;

/// Correlation from which on two parameters are told together only.
const STRONG: f64 = 0.9;

/// Whether measures tell a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identified {
    /// Its 95 % interval covers less than 35 % of the prior.
    Well,
    /// Up to 70 %.
    Weakly,
    /// More.
    No,
}

/// What is known of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterEstimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Mean of the posterior.
    pub mean: f64,
    /// Its median.
    pub median: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Central intervals with 50, 90 and 95 % of it.
    pub intervals: [[f64; 2]; 3],
    /// 1 − variance of the posterior over that of the prior, on the scale on which the prior is
    /// uniform: 1 for a parameter that is known, 0 for one of which nothing was learned.
    pub contraction: f64,
    /// Share of the prior that the 95 % interval covers.
    pub share_of_prior: f64,
    /// Whether the measures let expect a value below its range, or above.
    pub beyond: Option<Beyond>,
}

/// An end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// Below it.
    Low,
    /// Above it.
    High,
}

impl ParameterEstimate {
    /// Whether the measures tell it.
    pub fn identified(&self) -> Identified {
        if self.share_of_prior >= NOT_FROM {
            Identified::No
        } else if self.share_of_prior >= WEAKLY_FROM {
            Identified::Weakly
        } else {
            Identified::Well
        }
    }

    /// The same in words.
    pub fn sentence(&self) -> String {
        let (name, share) = (self.parameter.name(), 100.0 * self.share_of_prior);
        let verb = match self.identified() {
            Identified::Well => "tell",
            Identified::Weakly => "hardly tell",
            Identified::No => "do not tell",
        };
        let beyond = match self.beyond {
            None => "",
            Some(Beyond::Low) => "; they ask for less than its range has",
            Some(Beyond::High) => "; they ask for more than its range has",
        };
        format!(
            "the measures {verb} {name}: its 95 % interval covers {share:.0} % of the prior{beyond}"
        )
    }
}

/// How two parameters go together in the posterior.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    /// Names of both.
    pub names: [String; 2],
    /// −1 to 1, on the scale on which the prior is uniform.
    pub value: f64,
}

impl Correlation {
    /// What a strong correlation means, in words; `None` for another.
    pub fn sentence(&self) -> Option<String> {
        let [one, other] = &self.names;
        let what = if self.value > 0.0 {
            "a ratio"
        } else {
            "a product"
        };
        (self.value.abs() >= STRONG).then(|| {
            format!(
                "{one} and {other} go together ({:.2}): the measures tell something like {what} of \
                 the two better than either",
                self.value
            )
        })
    }
}

/// What a sample of places with weights that add up to 1 says of each parameter.
pub(super) fn estimates(
    problem: &Problem,
    sample: &[(Vec<f64>, f64)],
    expected: &[f64],
) -> Vec<ParameterEstimate> {
    let one = |(index, parameter): (usize, &Parameter)| {
        let mut places: Vec<(f64, f64)> = sample.iter().map(|(p, w)| (p[index], *w)).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let place = |share| quantile(&places, share);
        let value = |share| parameter.at(place(share));
        let ends = |level: f64| [0.5 - 0.5 * level, 0.5 + 0.5 * level];
        let values = places.iter().map(|(x, w)| (parameter.at(*x), *w));
        let (mean, variance) = mean_and_variance(values);
        let (_, spread) = mean_and_variance(places.iter().copied());
        let [low, high] = ends(LEVELS[2]).map(place);
        ParameterEstimate {
            parameter: parameter.clone(),
            mean,
            median: value(0.5),
            deviation: variance.sqrt(),
            intervals: LEVELS.map(|level| ends(level).map(value)),
            contraction: 1.0 - 12.0 * spread,
            share_of_prior: high - low,
            beyond: match expected[index] {
                x if x < 0.0 => Some(Beyond::Low),
                x if x > 1.0 => Some(Beyond::High),
                _ => None,
            },
        }
    };
    problem.parameters.iter().enumerate().map(one).collect()
}

fn mean_and_variance(values: impl Iterator<Item = (f64, f64)> + Clone) -> (f64, f64) {
    let mean: f64 = values.clone().map(|(x, w)| w * x).sum();
    let square = |x: f64| (x - mean) * (x - mean);
    (mean, values.map(|(x, w)| w * square(x)).sum())
}

/// Each pair's correlation.
pub(super) fn correlations(problem: &Problem, sample: &[(Vec<f64>, f64)]) -> Vec<Correlation> {
    let points = sample.iter().map(|(place, w)| (place.as_slice(), *w));
    let (_, covariance) = moments(points, problem.parameters.len());
    let mut found = Vec::new();
    for (i, one) in problem.parameters.iter().enumerate() {
        for (j, other) in problem.parameters.iter().enumerate().skip(i + 1) {
            let scale = (covariance[i][i] * covariance[j][j]).sqrt();
            let value = if scale > 0.0 {
                covariance[i][j] / scale
            } else {
                0.0
            };
            let names = [one, other].map(|parameter| parameter.name().to_owned());
            found.push(Correlation {
                names,
                value: value.clamp(-1.0, 1.0),
            });
        }
    }
    found
}

/// The place below which a share of the weights lies, on straight lines between the middles of the
/// steps of the sum; `sorted` holds places, not empty, and weights that add up to 1.
pub(super) fn quantile(sorted: &[(f64, f64)], share: f64) -> f64 {
    let mut before = 0.0;
    let mut last: Option<(f64, f64)> = None;
    for &(place, weight) in sorted {
        let middle = before + 0.5 * weight;
        if middle >= share {
            return match last {
                Some((below, at)) if middle > at => {
                    below + (place - below) * (share - at) / (middle - at)
                }
                Some(_) | None => place,
            };
        }
        last = Some((place, middle));
        before += weight;
    }
    last.map_or(0.0, |(place, _)| place)
}
