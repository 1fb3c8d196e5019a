//! Nearest points of a point and a triangle, and of two straight edges.

use glam::DVec3;

/// The point of a triangle nearest to `p`, as shares of its corners (Ericson 2005, 5.1.5).
pub(super) fn on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let sum = va + vb + vc;
    [va / sum, vb / sum, vc / sum]
}

/// The nearest points of two edges, as shares of the way along each (Ericson 2005, 5.1.9).
pub(super) fn of_edges([p, q]: [DVec3; 2], [r, s]: [DVec3; 2]) -> [f64; 2] {
    let (d1, d2, away) = (q - p, s - r, p - r);
    let (a, e, f) = (d1.length_squared(), d2.length_squared(), d2.dot(away));
    let (b, c) = (d1.dot(d2), d1.dot(away));
    if a <= f64::MIN_POSITIVE || e <= f64::MIN_POSITIVE {
        let along = |num: f64, den: f64| {
            if den > 0.0 {
                (num / den).clamp(0.0, 1.0)
            } else {
                0.0
            }
        };
        return [along(-c, a), along(f, e)];
    }
    let whole = a * e - b * b;
    let mut first = if whole > 1e-12 * a * e {
        ((b * f - c * e) / whole).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let mut second = (b * first + f) / e;
    if !(0.0..=1.0).contains(&second) {
        second = second.clamp(0.0, 1.0);
        first = ((b * second - c) / a).clamp(0.0, 1.0);
    }
    [first, second]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn place() -> impl Strategy<Value = DVec3> {
        [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(DVec3::from_array)
    }

    proptest! {
        #![proptest_config(fixed(300))]
        #[test]
        fn no_other_point_is_nearer(p in place(), t in [place(), place(), place()], q in place()) {
            let shares = on_triangle(p, t);
            prop_assert!(shares.iter().all(|s| (-1e-12..=1.0 + 1e-12).contains(s)));
            prop_assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
            let at = |[a, b, c]: [f64; 3]| t[0] * a + t[1] * b + t[2] * c;
            let found = at(shares).distance(p);
            for i in 0..=20_i32 {
                for j in 0..=20 - i {
                    let [u, v] = [i, j].map(|k| 0.05 * f64::from(k));
                    prop_assert!(found <= at([u, v, 1.0 - u - v]).distance(p) + 1e-9);
                }
            }
            let [one, other] = [[p, q], [t[0], t[1]]];
            let [s, r] = of_edges(one, other);
            let found = one[0].lerp(one[1], s).distance(other[0].lerp(other[1], r));
            for i in 0..=400_i32 {
                let [u, v] = [i % 21, i / 21].map(|k| 0.05 * f64::from(k));
                let tried = one[0].lerp(one[1], u).distance(other[0].lerp(other[1], v));
                prop_assert!(found <= tried + 1e-9);
            }
        }
    }
}
