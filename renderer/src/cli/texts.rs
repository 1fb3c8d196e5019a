//! Text files that commands are given: tables, networks, drawings, measures.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use super::Failure;
use crate::measured::series;

/// Most bytes of a table, a network or a drawing.
const MOST_BYTES: u64 = 512 << 20;

/// The text of a file; a note says so if its encoding is a guess.
pub(super) fn text_of(path: &Path) -> Result<String, Failure> {
    let bytes = bytes_of(path, MOST_BYTES)?;
    let decoded = series::text(&bytes).map_err(|fault| Failure::bad(fault.shown(path, "")))?;
    if let Some(guess) = decoded.guess() {
        eprintln!("note: {}: {guess}", path.display());
    }
    Ok(decoded.text.into_owned())
}

/// The bytes of a file, which may be a pipe or a device without end.
pub(super) fn bytes_of(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let shown = path.display();
    let refused = |error: std::io::Error| Failure::bad(format!("{shown}: {error}"));
    let file = File::open(path).map_err(refused)?;
    let length = file.metadata().map_err(refused)?.len();
    let mut bytes = Vec::new();
    if length <= most {
        let mut file = file.take(most + 1);
        file.read_to_end(&mut bytes).map_err(refused)?;
    }
    if length.max(bytes.len() as u64) > most {
        return Err(Failure::bad(format!(
            "{shown} has more than the {most} bytes that are read"
        )));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit_even_if_it_does_not_say_how_long_it_is() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.csv");
        std::fs::write(&file, "12345").expect("the folder can be written");
        assert_eq!(bytes_of(&file, 5).expect("short enough"), b"12345");
        let Err(Failure::BadInput(said)) = bytes_of(&file, 4) else {
            panic!("it is too long");
        };
        assert!(said.contains("more than the 4 bytes"), "{said}");
        if cfg!(unix) {
            let endless = bytes_of(Path::new("/dev/zero"), 1 << 16);
            assert!(matches!(endless, Err(Failure::BadInput(_))));
        }
    }
}
