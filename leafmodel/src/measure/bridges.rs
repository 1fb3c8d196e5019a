//! Pipes whose cut cuts something off.

use super::laplacian::Pipe;
use crate::buckets::Buckets;

/// For each pipe what leaves beyond it, if its cut parts that from the ground; `None` for others.
///
/// A search in depth from the ground, all of whose nodes are one (\[tarjan1974\]). Every unknown must
/// be joined to the ground.
pub(super) fn beyond(count: usize, pipes: &[Pipe], outflow: &[f64]) -> Vec<Option<f64>> {
    let ground = count as u32;
    let end_of = |end: u32| if end == Pipe::GROUND { ground } else { end };
    let around = Buckets::around(count + 1, pipes.iter().map(|pipe| pipe.ends.map(end_of)));
    let mut beyond = vec![None; pipes.len()];
    let mut found = vec![0_u32; count + 1];
    let mut lowest = vec![0_u32; count + 1];
    let mut sums: Vec<f64> = outflow.iter().copied().chain([0.0]).collect();
    let mut met = vec![0_usize; count + 1];
    let mut time = 1;
    found[ground as usize] = time;
    lowest[ground as usize] = time;
    // Nodes on the way from the ground, each with the pipe by which it was reached.
    let mut way = vec![(ground, u32::MAX)];
    while let Some(&(node, by)) = way.last() {
        let here = node as usize;
        if let Some(&pipe) = around.list(here).get(met[here]) {
            met[here] += 1;
            if pipe == by {
                continue;
            }
            let [a, b] = pipes[pipe as usize].ends.map(end_of);
            let other = if a == node { b } else { a };
            if found[other as usize] == 0 {
                time += 1;
                found[other as usize] = time;
                lowest[other as usize] = time;
                way.push((other, pipe));
            } else {
                lowest[here] = lowest[here].min(found[other as usize]);
            }
            continue;
        }
        way.pop();
        if let Some(&(before, _)) = way.last() {
            let before = before as usize;
            lowest[before] = lowest[before].min(lowest[here]);
            if lowest[here] > found[before] {
                beyond[by as usize] = Some(sums[here]);
            }
            sums[before] += sums[here];
        }
    }
    beyond
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bridges_are_found_with_what_lies_beyond() {
        // Ground – 0 – a ring 1 2 3 – 4, and a second way from the ground to 5 and 6.
        let ends = [
            [Pipe::GROUND, 0],
            [0, 1],
            [1, 2],
            [2, 3],
            [3, 1],
            [3, 4],
            [Pipe::GROUND, 5],
            [5, 6],
            [6, Pipe::GROUND],
        ];
        let pipes = ends.map(|ends| Pipe {
            ends,
            conductance: 1.0,
        });
        let outflow = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
        let found = beyond(7, &pipes, &outflow);
        let expected = [
            Some(31.0),
            Some(30.0),
            None,
            None,
            None,
            Some(16.0),
            None,
            None,
            None,
        ];
        assert_eq!(found, expected);
    }
}
