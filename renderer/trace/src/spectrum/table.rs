//! Tables over wavelength that ship with the program.

/// Reads comma-separated rows of a shipped table; `#` lines and the header line are skipped.
///
/// Each row gives the wavelength in nm and `C` values.
///
/// # Panics
///
/// If the shipped table is damaged, which means that the build is broken.
pub(crate) fn parse_shipped<const C: usize>(text: &str) -> Vec<(f64, [f64; C])> {
    text.lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| {
            let mut fields = line.split(',').map(|field| {
                field
                    .trim()
                    .parse::<f64>()
                    .expect("a shipped table holds numbers only")
            });
            let nm = fields.next().expect("a row starts with its wavelength");
            let values = std::array::from_fn(|_| fields.next().expect("a row is complete"));
            (nm, values)
        })
        .collect()
}
