//! How much a leaf fluoresces: one number, or a table over light and temperature.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::Number;

use super::number_rows::NumberRows;

/// Yields, and what they may be.
const YIELDS: Limits = Limits::closed(1e-6, 1.0);
const ROWS: NumberRows<3> = NumberRows {
    columns: ["irradiance_umol_m2_s", "temperature_c", "yield"],
    least: 1,
    limits: Limits::closed(-273.15, 1e6),
    wanted: "a list of [irradiance in µmol/(m² s), temperature in °C, yield]",
    about: [
        "Yields at every pair of some irradiances and temperatures, in any order.",
        "Such rows in a file with the columns `irradiance_umol_m2_s`, `temperature_c` and `yield`.",
    ],
    help: "write the names `irradiance_umol_m2_s`, `temperature_c` and `yield`, and three numbers in each line below",
};

/// A table, and where it is read.
#[derive(Clone, Debug, Default)]
struct Yields {
    rows: Vec<[f64; 3]>,
    irradiance: f64,
    temperature: f64,
}

/// The keys `quantum_efficiency` and `yields`.
pub(in crate::scene) fn declare(own: &mut f64, keys: &mut Keys<'_>) {
    keys.exclude("quantum_efficiency", "yields");
    let about = "Photons emitted for each photon that chlorophyll absorbs: 0.005 to 0.02 in daylight, more where \
        photosynthesis is blocked.";
    keys.key("quantum_efficiency", own, Number(YIELDS), about);
    let mut yields = None;
    let about = "A table of them over light and temperature, instead.";
    keys.optional_block("yields", &mut yields, Yields::default, about, |yields, keys| {
        let about = "Irradiance of the leaf from 400 to 700 nm (PAR), within the table.";
        let limits = Number(Limits::closed(0.0, 1e6));
        keys.required("irradiance_umol_m2_s", &mut yields.irradiance, limits, about);
        let about = "Temperature of the leaf, within the table.";
        let limits = Number(Limits::closed(-273.15, 1000.0));
        keys.required("temperature_c", &mut yields.temperature, limits, about);
        ROWS.declare(&mut yields.rows, keys);
        if !keys.is_sound() {
            return;
        }
        if let Err((key, problem)) = yields.at() {
            let help = "write yields of 1e-6 to 1 at every pair of the irradiances and temperatures of the table, and a \
                place within it";
            keys.refuse(&[key], problem, help);
        }
    });
    if let Some(Ok(efficiency)) = yields.map(|yields| yields.at()) {
        *own = efficiency;
    }
}

impl Yields {
    /// The yield, linear in both between rows; or the key that is wrong, and why.
    fn at(&self) -> Result<f64, (&'static str, String)> {
        let axis = |column: usize| {
            let mut values: Vec<f64> = self.rows.iter().map(|row| row[column]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        };
        let (lights, temperatures) = (axis(0), axis(1));
        for row in &self.rows {
            if !YIELDS.contain(row[2]) {
                return Err((
                    "yields",
                    format!("the yield {} does not lie between 1e-6 and 1", row[2]),
                ));
            }
        }
        if self.rows.len() != lights.len() * temperatures.len() {
            let problem = format!(
                "{} rows are not one for each pair of {} irradiances and {} temperatures",
                self.rows.len(),
                lights.len(),
                temperatures.len()
            );
            return Err(("yields", problem));
        }
        let of = |light: f64, temperature: f64| {
            let found = self
                .rows
                .iter()
                .find(|row| row[0] == light && row[1] == temperature);
            let missing = || {
                (
                    "yields",
                    format!("there is no yield at {light} µmol/(m² s) and {temperature} °C"),
                )
            };
            found.map(|row| row[2]).ok_or_else(missing)
        };
        let ([dim, bright], along) = between(&lights, self.irradiance)
            .map_err(|problem| ("irradiance_umol_m2_s", problem))?;
        let ([cool, warm], beyond) = between(&temperatures, self.temperature)
            .map_err(|problem| ("temperature_c", problem))?;
        let mix = |a: f64, b: f64, along: f64| a + (b - a) * along;
        Ok(mix(
            mix(of(dim, cool)?, of(bright, cool)?, along),
            mix(of(dim, warm)?, of(bright, warm)?, along),
            beyond,
        ))
    }
}

/// The values of an axis around one, and how far it lies from the first to the second.
fn between(axis: &[f64], value: f64) -> Result<([f64; 2], f64), String> {
    let (Some(&least), Some(&most)) = (axis.first(), axis.last()) else {
        return Err("the table has no rows".to_owned());
    };
    if !(least..=most).contains(&value) {
        return Err(format!(
            "{value} lies outside of the table, from {least} to {most}"
        ));
    }
    let above = axis.partition_point(|own| *own < value);
    let (low, high) = (axis[above.saturating_sub(1)], axis[above]);
    let along = if high > low {
        (value - low) / (high - low)
    } else {
        0.0
    };
    Ok(([low, high], along))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(
        rows: &[[f64; 3]],
        irradiance: f64,
        temperature: f64,
    ) -> Result<f64, (&'static str, String)> {
        Yields {
            rows: rows.to_vec(),
            irradiance,
            temperature,
        }
        .at()
    }

    #[test]
    fn yields_are_linear_between_rows_in_both_directions() {
        // Of a + b x + c y + d x y, all is found again.
        let of = |x: f64, y: f64| 0.01 + 2e-6 * x + 1e-4 * y - 4e-8 * x * y;
        let mut rows = Vec::new();
        for y in [25.0, 10.0, 30.0] {
            for x in [2000.0, 0.0, 300.0] {
                rows.push([x, y, of(x, y)]);
            }
        }
        for (x, y) in [
            (0.0, 10.0),
            (2000.0, 30.0),
            (300.0, 25.0),
            (117.0, 12.5),
            (1500.0, 29.0),
        ] {
            let found = at(&rows, x, y).expect("it lies within");
            assert!((found - of(x, y)).abs() < 1e-15, "{x} {y}: {found}");
        }
        assert_eq!(at(&[[500.0, 20.0, 0.02]], 500.0, 20.0), Ok(0.02));
    }

    #[test]
    fn what_a_table_does_not_say_is_refused() {
        let whole = [
            [0.0, 10.0, 0.01],
            [9.0, 10.0, 0.02],
            [0.0, 20.0, 0.01],
            [9.0, 20.0, 0.02],
        ];
        assert_eq!(
            at(&whole, 9.5, 10.0).map_err(|(key, _)| key),
            Err("irradiance_umol_m2_s")
        );
        assert_eq!(
            at(&whole, 9.0, 9.0).map_err(|(key, _)| key),
            Err("temperature_c")
        );
        assert_eq!(
            at(&whole[..3], 1.0, 10.0).map_err(|(key, _)| key),
            Err("yields")
        );
        assert_eq!(
            at(&[], 1.0, 10.0).map_err(|(key, _)| key),
            Err("irradiance_umol_m2_s")
        );
        let [first, .., last] = whole;
        assert_eq!(
            at(&[first, first, last, last], 1.0, 10.0).map_err(|(key, _)| key),
            Err("yields")
        );
        assert_eq!(
            at(&[[1.0, 10.0, 0.0]], 1.0, 10.0).map_err(|(key, _)| key),
            Err("yields")
        );
    }
}
