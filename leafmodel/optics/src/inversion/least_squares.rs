//! Least squares within bounds.
//!
//! - **In**: a function from parameters to residuals, bounds, a start.
//! - **Out**: the parameters of a local minimum of the sum of squares within the bounds, which of them
//!   the residuals determine, and how each residual moves those.
//!
//! Covariances hold for residuals that scatter more in some places than in others, as noise does
//! that is a fraction of the signal.
//!
//! Steps are those of Levenberg and Marquardt in the parameters that are free to move, cut at the
//! bounds; a parameter at a bound is held while the sum falls beyond it.
//!
//! # Source
//!
//! \[kanzow2004\] for steps within bounds; \[more1978\] for the scaled damping; \[mackinnon1985\],
//! estimator HC1, for the standard errors.

/// Relative change of the sum of squares below which a minimum is taken as found.
const FLAT: f64 = 1e-13;
/// Greatest number of steps.
const MOST_STEPS: usize = 400;
/// Step of differences, as a share of a parameter's scale.
const DIFFERENCE: f64 = 1e-5;
/// Damping from which no step can help any more.
const MOST_DAMPING: f64 = 1e12;
/// Share of a diagonal that must be left of a pivot: below, the parameter is not told from others.
const LEAST_PIVOT: f64 = 1e-11;
/// Share of the square of a parameter's effect that another has in the sum of others that equals it.
const LEAST_PART: f64 = 1e-6;

/// A parameter: where it may be, and a step that matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Least and greatest value.
    pub bounds: [f64; 2],
    /// A change that matters, > 0.
    pub scale: f64,
}

/// A minimum.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// Sum of squares of the residuals.
    pub sum: f64,
    /// Residuals at the minimum.
    pub left: Vec<f64>,
    /// What holds for each parameter.
    pub states: Vec<State>,
    /// Change of each determined parameter, in their order, with each residual.
    pub influence: Vec<Vec<f64>>,
    /// Number of unknowns that the residuals were fitted by.
    pub unknowns: usize,
}

/// What is known of a parameter at a minimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The residuals determine it.
    Determined,
    /// It is at a bound, beyond which the sum falls.
    AtBound,
    /// It does not change the residuals.
    WithoutInfluence,
    /// Others change the residuals as it does.
    LikeOthers,
    /// There are not more residuals than unknowns.
    TooFewResiduals,
}

impl Minimum {
    /// The covariance of the determined parameters, if the residuals are independent.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let count = self.left.len() as f64;
        let spare = count - self.unknowns as f64;
        let moved = |a: &[f64], b: &[f64]| -> f64 {
            let parts = a.iter().zip(b).zip(&self.left);
            parts.map(|((a, b), left)| a * b * left * left).sum::<f64>() * count / spare
        };
        let line = |a: &Vec<f64>| self.influence.iter().map(|b| moved(a, b)).collect();
        self.influence.iter().map(line).collect()
    }
}

/// Minimises the sum of squares of `residuals(parameters)` from a start within the bounds.
pub fn minimise(
    known: &[Parameter],
    start: &[f64],
    mut residuals: impl FnMut(&[f64]) -> Vec<f64>,
) -> Minimum {
    let mut at: Vec<f64> = start.to_vec();
    let mut left = residuals(&at);
    let mut sum = squares(&left);
    let mut damping = 1e-3;
    let mut calm = 0;
    for _ in 0..MOST_STEPS {
        let system = System::of(known, &at, &left, &mut residuals);
        let free = system.free(known, &at);
        let mut moved = false;
        while damping < MOST_DAMPING {
            let Some(step) = system.step(&free, damping) else {
                damping *= 10.0;
                continue;
            };
            let mut next = at.clone();
            for ((value, step), parameter) in next.iter_mut().zip(&step).zip(known) {
                let [low, high] = parameter.bounds;
                *value = (*value + step * parameter.scale).clamp(low, high);
            }
            let after = residuals(&next);
            let less = squares(&after);
            if less < sum {
                calm = if sum - less <= FLAT * sum {
                    calm + 1
                } else {
                    0
                };
                (at, left, sum) = (next, after, less);
                damping = (damping / 5.0).max(1e-15);
                moved = true;
                break;
            }
            damping *= 4.0;
        }
        if !moved || calm >= 2 {
            break;
        }
    }
    let system = System::of(known, &at, &left, &mut residuals);
    let (states, unknowns, influence) = system.determined(known, &at, left.len());
    Minimum {
        parameters: at,
        sum,
        left,
        states,
        influence,
        unknowns,
    }
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// The normal equations in parameters over their scales.
struct System {
    /// Half of the gradient.
    gradient: Vec<f64>,
    /// Jᵀ J.
    matrix: Vec<Vec<f64>>,
    /// J, column by column.
    columns: Vec<Vec<f64>>,
}

impl System {
    fn of(
        known: &[Parameter],
        at: &[f64],
        left: &[f64],
        residuals: &mut impl FnMut(&[f64]) -> Vec<f64>,
    ) -> Self {
        let columns: Vec<Vec<f64>> = (0..at.len())
            .map(|i| {
                let [low, high] = known[i].bounds;
                let step = DIFFERENCE * known[i].scale;
                let mut near = |to: f64| {
                    let mut near = at.to_vec();
                    near[i] = to.clamp(low, high);
                    (near[i], residuals(&near))
                };
                let (above, up) = near(at[i] + step);
                let (below, down) = near(at[i] - step);
                let wide = (above - below) / known[i].scale;
                up.iter()
                    .zip(&down)
                    .map(|(up, down)| (up - down) / wide)
                    .collect()
            })
            .collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        Self {
            gradient: columns.iter().map(|column| dot(column, left)).collect(),
            matrix: columns
                .iter()
                .map(|a| columns.iter().map(|b| dot(a, b)).collect())
                .collect(),
            columns,
        }
    }

    /// Whether each parameter may move: it is at no bound, or the sum falls towards the inside.
    fn free(&self, known: &[Parameter], at: &[f64]) -> Vec<bool> {
        (0..at.len())
            .map(|i| {
                let [low, high] = known[i].bounds;
                let held = (at[i] <= low && self.gradient[i] >= 0.0)
                    || (at[i] >= high && self.gradient[i] <= 0.0);
                !held && self.matrix[i][i] > 0.0
            })
            .collect()
    }

    /// The step of the free parameters with their diagonal damped; `None` if that cannot be solved.
    fn step(&self, free: &[bool], damping: f64) -> Option<Vec<f64>> {
        let numbers: Vec<usize> = (0..free.len()).filter(|&i| free[i]).collect();
        let factor = Factor::of(&self.matrix, &numbers, damping, 0.0).ok()?;
        let right: Vec<f64> = numbers.iter().map(|&i| -self.gradient[i]).collect();
        let mut step = vec![0.0; free.len()];
        for (&i, value) in numbers.iter().zip(factor.solve(right)) {
            step[i] = value;
        }
        Some(step)
    }

    /// What holds for each parameter, the number of unknowns, and how each residual moves what is
    /// determined. Of parameters that change the residuals alike none is.
    fn determined(
        &self,
        known: &[Parameter],
        at: &[f64],
        residuals: usize,
    ) -> (Vec<State>, usize, Vec<Vec<f64>>) {
        let free = self.free(known, at);
        let mut states: Vec<State> = (0..at.len())
            .map(|i| match (self.matrix[i][i] > 0.0, free[i]) {
                (true, true) => State::Determined,
                (true, false) => State::AtBound,
                (false, _) => State::WithoutInfluence,
            })
            .collect();
        let is_determined = |state: &State| *state == State::Determined;
        let mut numbers: Vec<usize> = (0..at.len())
            .filter(|&i| is_determined(&states[i]))
            .collect();
        let factor = loop {
            match Factor::of(&self.matrix, &numbers, 0.0, LEAST_PIVOT) {
                Ok(factor) => break factor,
                Err(place) => {
                    let like = numbers.remove(place);
                    states[like] = State::LikeOthers;
                    // The sum of others that changes the residuals as it does.
                    let before = &numbers[..place];
                    let right = before.iter().map(|&j| self.matrix[j][like]).collect();
                    let parts = Factor::of(&self.matrix, before, 0.0, LEAST_PIVOT)
                        .map_or_else(|_| Vec::new(), |factor| factor.solve(right));
                    for (&j, part) in before.iter().zip(parts) {
                        let size = part * part * self.matrix[j][j];
                        if size > LEAST_PART * self.matrix[like][like] {
                            states[j] = State::LikeOthers;
                        }
                    }
                }
            }
        };
        if residuals <= numbers.len() {
            for state in states
                .iter_mut()
                .filter(|state| **state == State::Determined)
            {
                *state = State::TooFewResiduals;
            }
        }
        let mut influence = Vec::new();
        for (place, &i) in numbers
            .iter()
            .enumerate()
            .filter(|(_, i)| is_determined(&states[**i]))
        {
            let unit = (0..numbers.len()).map(|other| f64::from(u8::from(other == place)));
            let row = factor.solve(unit.collect());
            let at = |at: usize| {
                let parts = row.iter().zip(&numbers);
                parts
                    .map(|(row, &j)| row * self.columns[j][at])
                    .sum::<f64>()
                    * known[i].scale
            };
            influence.push((0..residuals).map(at).collect());
        }
        (states, numbers.len(), influence)
    }
}

/// Cholesky's factor of a part of a matrix, lower triangle row by row.
struct Factor(Vec<Vec<f64>>);

impl Factor {
    /// Of the rows and columns with these numbers; the place of the first pivot that is not above
    /// a share of its diagonal is the error.
    fn of(matrix: &[Vec<f64>], numbers: &[usize], damping: f64, least: f64) -> Result<Self, usize> {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(numbers.len());
        for (i, &row) in numbers.iter().enumerate() {
            let mut line = vec![0.0; i + 1];
            for (j, &column) in numbers[..=i].iter().enumerate() {
                let before = if j < i { &rows[j][..j] } else { &line[..j] };
                let known: f64 = line[..j].iter().zip(before).map(|(a, b)| a * b).sum();
                let value = matrix[row][column] - known;
                if j < i {
                    line[j] = value / rows[j][j];
                } else {
                    let diagonal = matrix[row][row];
                    let pivot = value + damping * diagonal;
                    if pivot.is_nan() || pivot <= least * diagonal {
                        return Err(i);
                    }
                    line[i] = pivot.sqrt();
                }
            }
            rows.push(line);
        }
        Ok(Self(rows))
    }

    fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let rows = &self.0;
        for i in 0..rows.len() {
            let known: f64 = rows[i][..i].iter().zip(&right).map(|(a, b)| a * b).sum();
            right[i] = (right[i] - known) / rows[i][i];
        }
        for i in (0..rows.len()).rev() {
            let known: f64 = (i + 1..rows.len()).map(|j| rows[j][i] * right[j]).sum();
            right[i] = (right[i] - known) / rows[i][i];
        }
        right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(count: usize) -> Vec<Parameter> {
        let parameter = Parameter {
            bounds: [-10.0, 10.0],
            scale: 1.0,
        };
        vec![parameter; count]
    }

    fn assert_near(found: f64, expected: f64, slack: f64) {
        assert!((found - expected).abs() <= slack, "{found}, not {expected}");
    }

    #[test]
    fn a_line_has_the_slope_and_the_standard_errors_of_the_formula() {
        // Anscombe's first set: y = 3.0001 + 0.5001 x; HC1 computed by hand from its closed form.
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [
            8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68,
        ];
        let found = minimise(&free(2), &[0.0, 0.0], |line| {
            x.iter()
                .zip(y)
                .map(|(x, y)| line[0] + line[1] * x - y)
                .collect()
        });
        assert_near(found.parameters[0], 3.0001, 1e-4);
        assert_near(found.parameters[1], 0.5001, 1e-4);
        assert_eq!(found.states, [State::Determined; 2]);
        let covariance = found.covariance();
        assert_near(covariance[0][0].sqrt(), 0.98949, 1e-4);
        assert_near(covariance[1][1].sqrt(), 0.11415, 1e-4);
        assert_eq!(covariance[0][1], covariance[1][0]);
        assert!(covariance[0][1] < 0.0, "{covariance:?}");
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        let found = minimise(&free(2), &[-1.2, 1.0], |p| {
            vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]
        });
        assert_near(found.parameters[0], 1.0, 1e-7);
        assert_near(found.parameters[1], 1.0, 1e-7);
    }

    #[test]
    fn a_minimum_beyond_a_bound_is_found_on_it_and_the_rest_is_best_there() {
        let mut known = free(2);
        known[0].bounds = [0.0, 10.0];
        // Without the bound x = −1, y = 2; on it y = 1.5.
        let found = minimise(&known, &[5.0, -5.0], |p| {
            vec![p[0] + 1.0, p[0] + 2.0 * p[1] - 3.0]
        });
        assert_eq!(found.parameters[0], 0.0);
        // The sum tells a parameter within the root of its rounding.
        assert_near(found.parameters[1], 1.5, 1e-7);
        assert_eq!(found.states, [State::AtBound, State::Determined]);
    }

    #[test]
    fn what_the_data_do_not_determine_is_named_with_all_that_act_alike() {
        let x = [1.0, 2.0, 3.0, 4.0];
        let y = [1.1, 1.9, 3.2, 3.9];
        // Only the sum of the first two counts; the third has no influence, the fourth its own.
        let found = minimise(&free(4), &[0.0; 4], |p| {
            x.iter()
                .zip(y)
                .map(|(x, y)| (p[0] + p[1]) * x + p[3] - y)
                .collect()
        });
        // The line through the four points.
        assert_near(found.parameters[0] + found.parameters[1], 0.97, 1e-6);
        assert_near(found.parameters[3], 0.1, 1e-6);
        let wanted = [
            State::LikeOthers,
            State::LikeOthers,
            State::WithoutInfluence,
            State::Determined,
        ];
        assert_eq!(found.states, wanted);
        assert_eq!((found.influence.len(), found.unknowns), (1, 2));
        let few = minimise(&free(2), &[0.0; 2], |p| vec![p[0] - 1.0, p[0] + p[1]]);
        assert_eq!(few.states, [State::TooFewResiduals; 2]);
    }
}
