//! Flows that balance, and resistances that are known.

use super::*;
use properties::uniform;

/// A square lattice of pipes whose conductances span many powers of ten; corner 0 is joined to
/// ground.
fn lattice(side: u32, seed: u64) -> (Vec<DVec2>, Vec<Pipe>) {
    let places = (0..side * side).map(|i| DVec2::new(f64::from(i % side), f64::from(i / side)));
    let mut pipes = vec![Pipe {
        ends: [0, Pipe::GROUND],
        conductance: 1.0,
    }];
    for i in 0..side * side {
        let more = [
            (i % side + 1 < side).then_some(i + 1),
            (i / side + 1 < side).then_some(i + side),
        ];
        for other in more.into_iter().flatten() {
            let random = uniform(seed, 80, pipes.len() as u64);
            pipes.push(Pipe {
                ends: [i, other],
                conductance: libm::pow(10.0, 8.0 * random),
            });
        }
    }
    (places.collect(), pipes)
}

#[test]
fn flows_balance_at_every_node_whatever_the_contrast() {
    for (side, seed) in [(1, 1), (2, 1), (7, 2), (30, 3)] {
        let (places, pipes) = lattice(side, seed);
        let inflow: Vec<f64> = (0..places.len() as u64)
            .map(|i| uniform(seed, 81, i))
            .collect();
        let factored = Factored::new(&places, &pipes).expect("a sound system");
        let pressure = factored.solve(&inflow);
        // All that flows in leaves through the one pipe to ground.
        let all: f64 = inflow.iter().sum();
        assert!(
            (pressure[0] - all).abs() < 1e-12 * all,
            "{} {all}",
            pressure[0]
        );
        // The dissipated power is the same by pipes and by inflows.
        let at = |end: u32| {
            if end == Pipe::GROUND {
                0.0
            } else {
                pressure[end as usize]
            }
        };
        let by_pipes: f64 = pipes
            .iter()
            .map(|pipe| pipe.conductance * (at(pipe.ends[0]) - at(pipe.ends[1])).powi(2))
            .sum();
        let by_nodes: f64 = inflow.iter().zip(&pressure).map(|(q, p)| q * p).sum();
        assert!(
            (by_pipes / by_nodes - 1.0).abs() < 1e-6,
            "{by_pipes} {by_nodes}"
        );
    }
}

#[test]
fn no_contrast_is_too_large_for_it() {
    let pipes = [
        Pipe {
            ends: [0, Pipe::GROUND],
            conductance: 1e-200,
        },
        Pipe {
            ends: [0, 1],
            conductance: 1.0,
        },
        Pipe {
            ends: [1, 2],
            conductance: 1e100,
        },
    ];
    let factored = Factored::new(&[DVec2::ZERO, DVec2::X, DVec2::Y], &pipes);
    let pressure = factored.expect("sums are finite").solve(&[0.0, 0.0, 1.0]);
    assert!(
        pressure.iter().all(|p| (p / 1e200 - 1.0).abs() < 1e-14),
        "{pressure:?}"
    );
    let endless = [Pipe {
        conductance: f64::INFINITY,
        ..pipes[0]
    }];
    assert!(Factored::new(&[DVec2::ZERO], &endless).is_none());
}

#[test]
fn the_resistance_between_neighbours_is_what_a_whole_solution_says() {
    let (places, pipes) = lattice(12, 5);
    let factored = Factored::new(&places, &pipes).expect("a sound system");
    let mut scratch = vec![0.0; places.len()];
    for pipe in &pipes[1..] {
        let [a, b] = pipe.ends;
        let mut inflow = vec![0.0; places.len()];
        (inflow[a as usize], inflow[b as usize]) = (1.0, -1.0);
        let pressure = factored.solve(&inflow);
        let expected = pressure[a as usize] - pressure[b as usize];
        let found = factored.resistance(pipe.ends, &mut scratch);
        assert!(
            (found - expected).abs() <= 1e-6 * found,
            "{found} {expected}"
        );
    }
    assert!(scratch.iter().all(|value| *value == 0.0));
    // Foster: in a connected graph the g R of all pipes add up to the number of unknowns.
    let sum: f64 = pipes
        .iter()
        .map(|pipe| pipe.conductance * factored.resistance(pipe.ends, &mut scratch))
        .sum();
    assert!((sum - 144.0).abs() < 1e-6, "{sum}");
}
