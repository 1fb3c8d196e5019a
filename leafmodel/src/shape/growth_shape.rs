//! Outlines that local growth rates bring forth by themselves (growth-algorithm model).

/// A row of cells that is a secondary vein: it sets the direction of growth and bears a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinRow {
    /// Place along the midrib, 0 at the petiole, 1 at the tip.
    pub position: f64,
    /// Slope `s` of the row: rise along the midrib per unit away from it, constant in growth.
    pub slope: f64,
}

/// Parameters of the growth algorithm; the letters are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthShape {
    /// `N`, rows of cells along the midrib, 3 or more. The paper's typical value is 150.
    pub rows: usize,
    /// `gy`, growth of the midrib per step, > 0. The paper's value is 0.1.
    pub axial_rate: f64,
    /// `R = gy / gL0`, axial over greatest lateral growth rate, > 0.
    pub rate_ratio: f64,
    /// `yd`, where along the midrib lateral growth is fastest, in (0, 1).
    pub widest_at: f64,
    /// `k`, how late lateral growth falls off away from there, > 0 (Eq. 3).
    pub falloff: f64,
    /// `a`, how fast growth falls off away from a vein, ≥ 0; 0 gives an entire leaf (Eq. 4).
    pub lobe_decay: f64,
    /// `n`, shape of that fall: 1 pointed lobes, 2 rounded ones (Eq. 4).
    pub lobe_exponent: f64,
    /// Secondary veins, from base to tip; none means slope 0 and no lobes.
    pub veins: Vec<VeinRow>,
}
