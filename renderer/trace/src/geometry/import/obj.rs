//! Wavefront OBJ.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use super::raw::{ImportError, MOST_CORNERS, RawMesh, shown};

/// The indices of a corner of a face, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Corner {
    position: u32,
    uv: Option<u32>,
    normal: Option<u32>,
}

/// Reads the text of an OBJ file. A vertex is made for each different corner.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ImportError> {
    let mut positions: Vec<Vec3> = Vec::new();
    let mut uvs: Vec<Vec2> = Vec::new();
    let mut normals: Vec<Vec3> = Vec::new();
    let mut vertices: BTreeMap<Corner, u32> = BTreeMap::new();
    let mut corners: Vec<Corner> = Vec::new();
    let mut raw = RawMesh::default();
    let mut face = Vec::new();

    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = (1..).zip(bytes.split(|&byte| byte == b'\n'));
    while let Some((line, text)) = lines.next() {
        let wrong = |what: String| ImportError::Line { line, what };
        let mut text = statement(text);
        // A statement goes on behind a backslash at the end of its line.
        while text.ends_with('\\') && is_read(&text) {
            text.to_mut().pop();
            let Some((_, more)) = lines.next() else {
                break;
            };
            let more = statement(more);
            text.to_mut().extend([" ", &more]);
        }
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let [x, y, z] = numbers(&mut words, 3).map_err(wrong)?;
                positions.push(Vec3::new(x, y, z));
            }
            Some("vn") => {
                let [x, y, z] = numbers(&mut words, 3).map_err(wrong)?;
                normals.push(Vec3::new(x, y, z));
            }
            Some("vt") => {
                let [u, v, _] = numbers(&mut words, 1).map_err(wrong)?;
                uvs.push(Vec2::new(u, v));
            }
            Some("f" | "fo") => {
                face.clear();
                for word in words {
                    let counts = [positions.len(), uvs.len(), normals.len()];
                    let corner = corner(word, counts).map_err(wrong)?;
                    let vertex = *vertices.entry(corner).or_insert_with(|| {
                        corners.push(corner);
                        corners.len() as u32 - 1
                    });
                    face.push(vertex);
                    if face.len() > MOST_CORNERS {
                        return Err(wrong(format!(
                            "the face has more than {MOST_CORNERS} corners"
                        )));
                    }
                }
                if face.len() < 3 {
                    return Err(wrong(format!(
                        "the face has {} corners; it takes 3",
                        face.len()
                    )));
                }
                raw.push_face(&face);
            }
            // Patches too, by the names that older files have.
            Some("surf" | "bsp" | "bzp" | "cdp") => raw.free_form += 1,
            // Lines, points, groups and materials are ignored.
            Some(_) | None => {}
        }
    }

    raw.positions = corners
        .iter()
        .map(|corner| positions[corner.position as usize])
        .collect();
    // If any corner lacks uvs, all uvs are dropped, since the texture would have gaps.
    raw.uvs = corners
        .iter()
        .map(|corner| corner.uv.map(|uv| uvs[uv as usize]))
        .collect();
    if corners.iter().any(|corner| corner.normal.is_some()) {
        let normal = |corner: &Corner| {
            corner
                .normal
                .map_or(Vec3::ZERO, |normal| normals[normal as usize])
        };
        raw.normals = Some(corners.iter().map(normal).collect());
    }
    Ok(raw)
}

/// A line without its comment and the space at its end. Comments and names may be in any encoding;
/// statements that are read are ASCII.
fn statement(line: &[u8]) -> Cow<'_, str> {
    let text = line.split(|&byte| byte == b'#').next().unwrap_or_default();
    String::from_utf8_lossy(text.trim_ascii_end())
}

/// Whether a line begins a statement that is read: others may end in a name with a backslash.
fn is_read(text: &str) -> bool {
    let word = text.split_ascii_whitespace().next();
    matches!(word, Some("v" | "vn" | "vt" | "f" | "fo"))
}

/// Three numbers, of which at least `least` must be given; missing ones are 0. Further ones (w,
/// colours) are ignored.
fn numbers<'a>(
    words: &mut impl Iterator<Item = &'a str>,
    least: usize,
) -> Result<[f32; 3], String> {
    let mut numbers = [0.0; 3];
    for (i, number) in numbers.iter_mut().enumerate() {
        match words.next() {
            Some(word) => {
                *number = word
                    .parse()
                    .map_err(|_| format!("{} is not a number", shown(word)))?;
            }
            None if i < least => return Err(format!("{i} numbers; it takes {least}")),
            None => break,
        }
    }
    Ok(numbers)
}

/// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, given the numbers of each read so far.
fn corner(word: &str, counts: [usize; 3]) -> Result<Corner, String> {
    const NAMES: [&str; 3] = ["vertex", "texture coordinate", "normal"];
    let mut found = [None; 3];
    for (i, part) in word.split('/').enumerate() {
        if i >= 3 {
            return Err(format!(
                "{} names more than vertex, texture coordinate and normal",
                shown(word)
            ));
        }
        if part.is_empty() {
            continue;
        }
        let number: i64 = part
            .parse()
            .map_err(|_| format!("{} is not an index", shown(part)))?;
        let count = i64::try_from(counts[i]).unwrap_or(i64::MAX);
        // Positive numbers count from the first, negative ones back from the last.
        let index = if number < 0 {
            count.saturating_add(number)
        } else {
            number - 1
        };
        if !(0..count).contains(&index) {
            return Err(format!(
                "{} {number} does not exist; {count} came before this line",
                NAMES[i]
            ));
        }
        let index = u32::try_from(index).map_err(|_| format!("more than 2^32 of {}", NAMES[i]))?;
        found[i] = Some(index);
    }
    Ok(Corner {
        position: found[0].ok_or_else(|| format!("{} names no vertex", shown(word)))?,
        uv: found[1],
        normal: found[2],
    })
}
