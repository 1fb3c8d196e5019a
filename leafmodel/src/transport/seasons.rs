//! Autumn: revenue falls, and cells whose revenue no longer covers their cost die (Remark 3.6 of
//! \[xia2007\]).

use super::leaf::TransportLeaf;
use crate::document::RangeError;
use crate::not_grown::NotGrown;

impl TransportLeaf {
    /// For each cell the share of the full-grown leaf's revenue `ε` at which it dies as `ε` falls
    /// to 0: 1 dies first, 0 last.
    ///
    /// A tip dies when the cost of its transport, `F` minus `F` without it, exceeds its revenue.
    /// Then its parent may become a tip. The share is a multiple of 1/`steps` (1 to 10 000). The
    /// remaining veins stay where they are. The root has 0. If revenue is a periodic function of
    /// time, a cell is alive in the falling half of a period while the share is above its value.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for `steps`.
    ///
    /// # Source
    ///
    /// \[xia2007\], Remark 3.6, which says that cells die, not how. The expense of an existing cell
    /// is our definition.
    pub fn deaths(&self, steps: u32) -> Result<Vec<f64>, NotGrown> {
        let valid = (1..=10_000).contains(&steps);
        RangeError::unless(valid, "steps", f64::from(steps), "1 to 10000")?;
        let plan = self.plan();
        let order = self.root_to_tip();
        let multiples = self.system().multiples();
        let powers: Vec<f64> = (0..=self.cells().len())
            .map(|w| libm::pow(w as f64, plan.alpha))
            .collect();
        let light = plan.revenue(self.seed());
        let earned: Vec<f64> = self.cells().iter().map(|&cell| light.of(cell)).collect();
        let full = plan.in_cells(plan.epsilon);
        let mut counts = self.counts().to_vec();
        let mut deaths = vec![0.0; order.len()];
        let mut alive = vec![true; order.len()];
        let mut expenses = vec![0.0; order.len()];
        for step in 0..=steps {
            let share = 1.0 - f64::from(step) / f64::from(steps);
            loop {
                for &v in &order[1..] {
                    if !alive[v] {
                        continue;
                    }
                    let p = self.parent(v).unwrap_or(0);
                    let length = (self.cells()[v] - self.cells()[p]).length();
                    let w = counts[v] as usize;
                    let saved = multiples[v] * length * (powers[w] - powers[w - 1]);
                    expenses[v] = expenses[p] + saved;
                }
                let fallen = |v: usize| counts[v] == 1 && expenses[v] > full * share * earned[v];
                let fallen: Vec<usize> = (1..order.len())
                    .filter(|&v| alive[v] && fallen(v))
                    .collect();
                for &v in &fallen {
                    alive[v] = false;
                    deaths[v] = share;
                    let mut z = Some(v);
                    while let Some(at) = z {
                        counts[at] -= 1;
                        z = self.parent(at);
                    }
                }
                if fallen.is_empty() {
                    break;
                }
            }
        }
        Ok(deaths)
    }
}
