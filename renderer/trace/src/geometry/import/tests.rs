use glam::{Vec2, Vec3};

use super::super::mesh::MeshError;
use super::{ImportError, import};
use crate::sampling::mixer::scramble;

const SQUARE: &str = "ply
format ascii 1.0
comment a square with a colour that is passed over
element vertex 4
property float x
property float y
property double z
property uchar red
property float s
property float t
element face 1
property list uchar int vertex_indices
element edge 1
property int a
property int b
end_header
0 0 0.5 9 0 0
2 0 0.5 9 1 0

2 2 0.5 9 1 1
0 2 0.5 9 0 1
4 0 1 2 3
0 1
";

/// The same square in binary, `big` end first or last.
fn binary(big: bool) -> Vec<u8> {
    let mut bytes = SQUARE
        .split("end_header\n")
        .next()
        .unwrap_or_default()
        .to_owned();
    bytes.push_str("end_header\n");
    let name = if big {
        "binary_big_endian"
    } else {
        "binary_little_endian"
    };
    let mut bytes = bytes.replace("ascii", name).into_bytes();
    let float = |x: f32| {
        if big {
            x.to_be_bytes()
        } else {
            x.to_le_bytes()
        }
    };
    let int = |x: i32| {
        if big {
            x.to_be_bytes()
        } else {
            x.to_le_bytes()
        }
    };
    for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0_f32]] {
        bytes.extend(float(2.0 * u));
        bytes.extend(float(2.0 * v));
        bytes.extend(if big {
            0.5_f64.to_be_bytes()
        } else {
            0.5_f64.to_le_bytes()
        });
        bytes.push(9);
        bytes.extend(float(u));
        bytes.extend(float(v));
    }
    bytes.push(4);
    for corner in [0, 1, 2, 3, 0, 1] {
        bytes.extend(int(corner));
    }
    bytes
}

const OBJ: &str = "# a square\r
mtllib ../../secret.mtl\r
v 0 0 0.5 1\r
v 2 0 0.5\r
v 2 2 0.5\r
v 0 2 0.5\r
vt 0 0\r
vt 1 0\r
vt 1 1\r
vt 0 1\r
vn 0 0 2\r
g leaf\r
f 1/1/1 2/2/1 -2/-2/-1 4/4/1\r
";

#[test]
fn every_format_gives_the_same_square() {
    let files = [
        (SQUARE.as_bytes().to_vec(), "ply"),
        (SQUARE.replace('\n', "\r\n").into_bytes(), "PLY"),
        (binary(false), "ply"),
        (binary(true), "ply"),
        (OBJ.as_bytes().to_vec(), "obj"),
    ];
    for (bytes, extension) in files {
        let mesh = import(&bytes, extension, 0.5).expect("the file is whole");
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let positions: Vec<_> = square.iter().map(|&[x, y]| Vec3::new(x, y, 0.25)).collect();
        let uvs: Vec<_> = square.into_iter().map(Vec2::from).collect();
        assert_eq!(mesh.positions(), positions);
        assert_eq!(mesh.uvs(), Some(&uvs[..]));
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
        let normals = (extension == "obj").then(|| vec![Vec3::Z * 2.0; 4]);
        assert_eq!(mesh.normals(), normals.as_deref());
    }
}

#[test]
fn an_obj_without_some_uvs_has_none_and_without_some_normals_uses_those_of_faces() {
    let text = OBJ.replace("2/2/1", "2");
    let mesh = import(text.as_bytes(), "obj", 1.0).expect("the file is whole");
    assert_eq!(mesh.uvs(), None);
    assert_eq!(mesh.normals().map(|normals| normals[1]), Some(Vec3::ZERO));
}

#[test]
fn faces_that_cross_themselves_are_counted() {
    // The second crosses itself with as much on one side as on the other.
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.5 0\nv 2 0 0\nv 3 1 0\nv 3 0 0\nv 2 1 0\n";
    let text = format!("{corners}f 1 2 3 4\nf 5 6 7 8\nf 2 4 6 8\nf 1 3 5 4\n");
    let mesh = import(text.as_bytes(), "obj", 1.0).expect("a mesh with odd faces");
    let remarks = mesh.remarks();
    let last = remarks.last().expect("two faces are odd");
    assert_eq!(last, "2 faces cross themselves, and are fans of triangles");
}

#[test]
fn errors_say_where() {
    let line = |text: String, extension: &str| match import(text.as_bytes(), extension, 1.0) {
        Err(ImportError::Line { line, what }) => (line, what),
        other => panic!("{other:?} is not an error with a line"),
    };
    for (from, to, at, word) in [
        ("4 0 1 2 3", "4 0 1 2", 22, "fewer"),
        ("4 0 1 2 3", "4 0 1 2 3 4", 22, "more"),
        ("4 0 1 2 3", "4 0 1 2 -3", 22, "vertex"),
        ("4 0 1 2 3", "2 0 1", 22, "2 corners"),
        ("4 0 1 2 3", "-1 0 1", 22, "length"),
        ("2 2 0.5 9", "2 x 0.5 9", 20, "\"x\""),
        ("property double z", "property double", 7, "property"),
        ("property double z", "property quad z", 7, "quad"),
        ("property double z", "property double w", 17, "x, y and z"),
        ("vertex_indices", "corners", 22, "vertex_indices"),
        ("format ascii 1.0", "format runes 1.0", 2, "runes"),
        ("end_header", "end_heade", 16, "end_heade"),
        ("ply", "plx", 1, "ply"),
    ] {
        let (line, what) = line(SQUARE.replacen(from, to, 1), "ply");
        assert_eq!(line, at, "{what}");
        assert!(what.contains(word), "{what:?} does not say {word:?}");
    }
    for (from, to, at, word) in [
        ("2/2/1", "0/2/1", 13, "vertex 0"),
        ("2/2/1", "5/2/1", 13, "vertex 5"),
        ("2/2/1", "2/9/1", 13, "texture coordinate 9"),
        ("2/2/1", "2/2/-2", 13, "normal -2"),
        ("2/2/1", "2/2/1/1", 13, "more than"),
        ("2/2/1", "two", 13, "\"two\""),
        ("2/2/1 -2/-2/-1 4/4/1", "2", 13, "2 corners"),
        ("v 2 2 0.5", "v 2 2", 5, "2 numbers"),
        ("v 2 2 0.5", "v 2 2 y", 5, "\"y\""),
    ] {
        let (line, what) = line(OBJ.replacen(from, to, 1), "obj");
        assert_eq!(line, at, "{what}");
        assert!(what.contains(word), "{what:?} does not say {word:?}");
    }
    let unknown = import(b"", "stl", 1.0)
        .map(|_| ())
        .expect_err("stl is not read");
    assert!(unknown.to_string().contains(".stl"));
    assert!(matches!(
        import(b"v 0 0 0", "obj", 1.0),
        Err(ImportError::Mesh(MeshError::Empty { .. }))
    ));
}

#[test]
fn claims_without_bytes_are_refused_at_once() {
    for (from, to) in [
        ("element vertex 4", "element vertex 4000000000"),
        ("element vertex 4", "element vertex 18446744073709551615"),
        ("element face 1", "element face 4000000000"),
        ("list uchar", "list uint"),
    ] {
        let whole = binary(false);
        let split = whole.len() - (4 * 25 + 1 + 6 * 4);
        let header = String::from_utf8(whole[..split].to_vec()).expect("the header is text");
        let bytes = [header.replacen(from, to, 1).as_bytes(), &whole[split..]].concat();
        let refused = import(&bytes, "ply", 1.0)
            .map(|_| ())
            .expect_err("the bytes are not there");
        assert!(
            matches!(refused, ImportError::Byte { .. }),
            "{to}: {refused}"
        );
    }
}

#[test]
fn damaged_files_give_a_mesh_or_an_error() {
    let files = [
        (SQUARE.as_bytes().to_vec(), "ply"),
        (binary(false), "ply"),
        (binary(true), "ply"),
        (OBJ.as_bytes().to_vec(), "obj"),
    ];
    let (mut read, mut refused) = (0, 0);
    for seed in 0..4000_u64 {
        let (whole, extension) = &files[seed as usize % 4];
        let mut bytes = whole.clone();
        for change in 0..=seed % 5 {
            let bits = scramble(seed << 8 | change);
            let at = (bits >> 8) as usize % bytes.len();
            match bits % 4 {
                0 => bytes[at] = (bits >> 40) as u8,
                1 => bytes[at] ^= 1 << (bits >> 40 & 7),
                2 => bytes.truncate(at.max(1)),
                _ => bytes.insert(at, b"0-/ 9\n"[(bits >> 40) as usize % 6]),
            }
        }
        match import(&bytes, extension, 1.0) {
            Ok(_) => read += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(
        read > 200 && refused > 2000,
        "{read} read, {refused} refused"
    );
}

#[test]
fn an_error_shows_no_more_of_a_file_than_a_line_has() {
    let long = "x".repeat(2_000_000);
    for (text, ending) in [
        (format!("v 0 0 {long}\n"), "obj"),
        (format!("f {long}\n"), "obj"),
        (format!("ply\nformat {long} 1.0\nend_header\n"), "ply"),
        (format!("ply\n{long}\nend_header\n"), "ply"),
    ] {
        let error = import(text.as_bytes(), ending, 1.0).expect_err("no mesh");
        let told = error.to_string();
        assert!(told.len() < 300, "{} bytes", told.len());
        assert!(told.contains("xxx") || told.contains("header"), "{told}");
    }
}

/// The area that a mesh covers, seen from +z: of what faces there, and all of it.
fn areas(text: &str) -> [f32; 2] {
    let mesh = import(text.as_bytes(), "obj", 1.0).expect("it is a mesh");
    let faces = mesh.triangles().iter().map(|face| {
        let [a, b, c] = face.map(|corner| mesh.positions()[corner as usize]);
        0.5 * (b - a).cross(c - a).z
    });
    faces.fold([0.0; 2], |[net, all], area| [net + area, all + area.abs()])
}

#[test]
fn a_concave_face_covers_itself_and_nothing_else() {
    let ell = "v 1 -1 0\nv 1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv -1 -1 0\n";
    assert_eq!(areas(&format!("{ell}f 1 2 3 4 5 6\n")), [3.0, 3.0]);
    assert_eq!(areas(&format!("{ell}f 6 5 4 3 2 1\n")), [-3.0, 3.0]);
    // Between other faces, whose order stays.
    let text = format!("{ell}f 6 1 2\nf 1 2 3 4 5 6\nf 4 5 6\n");
    let mesh = import(text.as_bytes(), "obj", 1.0).expect("it is a mesh");
    let corners = |face: usize| {
        let corners = mesh.triangles()[face];
        corners.map(|corner| mesh.positions()[corner as usize])
    };
    assert_eq!(corners(0)[1..], [Vec3::new(1.0, -1.0, 0.0), Vec3::X]);
    let last = mesh.triangles().len() - 1;
    assert_eq!(corners(last)[..2], [Vec3::Y, Vec3::new(-1.0, 1.0, 0.0)]);
}

#[test]
fn a_face_that_begins_on_a_line_or_repeats_a_corner_is_whole() {
    let text = "v -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4 5\n";
    assert_eq!(areas(text), [4.0, 4.0]);
    let mesh = import(text.as_bytes(), "obj", 1.0).expect("it is a mesh");
    assert_eq!((mesh.triangles().len(), mesh.dropped().total()), (3, 0));
    let repeated = text.replace("f 1 2 3 4 5", "f 1 1 3 4 4 5");
    assert_eq!(areas(&repeated), [4.0, 4.0]);
    let mesh = import(repeated.as_bytes(), "obj", 1.0).expect("it is a mesh");
    assert_eq!(mesh.dropped().total(), 0);
}

#[test]
fn poles_of_spheres_leave_their_faces_without_area_out() {
    // A pole as quads of which two corners are one, or two vertices at one place.
    let text =
        "v 0 0 1\nv 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 3 4\nf 1 2 3\nf 2 2 3\nf 1 3 4 1\nf 3 4 3\n";
    let mesh = import(text.as_bytes(), "obj", 1.0);
    // The quad is the triangle again.
    let refused = mesh.map(|_| ()).expect_err("a fifth is duplicate");
    assert!(
        refused.to_string().contains("3 without area, 1 duplicate"),
        "{refused}"
    );
    let mesh = import(text.replace("f 1 3 4 1\n", "").as_bytes(), "obj", 1.0);
    let mesh = mesh.expect("faces without area do no harm");
    assert_eq!((mesh.triangles().len(), mesh.dropped().degenerate), (1, 3));
}

#[test]
fn statements_of_an_obj_go_on_behind_a_backslash() {
    let plain = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let broken = "v 0 \\\n0 0\r\nv 1 0 0 # C:\\\nv 1 1 0\nv 0 1 0\no C:\\\nf 1 2 \\\r\n3 \\\n4\n";
    assert_eq!(areas(broken), areas(plain));
    let wrong = import(b"v 0 0 \\\nx\nf 1 2 3", "obj", 1.0).map(|_| ());
    assert_eq!(
        wrong.expect_err("x is no number").to_string(),
        "line 1: \"x\" is not a number"
    );
    assert!(import(b"v 0 0 0\nf 1 1 1 \\", "obj", 1.0).is_err());
}

#[test]
fn strips_of_triangles_of_a_ply_are_read_beside_faces_and_alone() {
    let strips = |faces: &str, more: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
             {faces}element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
             0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n{more}9 0 1 2 3 -1 2 3 4 5\n"
        )
    };
    let alone = import(strips("", "").as_bytes(), "ply", 1.0).expect("four triangles");
    assert_eq!(
        alone.triangles(),
        [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]
    );
    for [a, b, c] in alone
        .triangles()
        .iter()
        .map(|face| face.map(|v| alone.positions()[v as usize]))
    {
        assert!(
            (b - a).cross(c - a).z > 0.0,
            "all are seen from the same side"
        );
    }
    let header = "element face 1\nproperty list int int vertex_indices\n";
    let both = import(strips(header, "3 0 3 5\n").as_bytes(), "ply", 1.0).expect("a mesh");
    assert_eq!(both.triangles().len(), 5);
    let wrong = strips("", "").replace("-1 2", "-2 2");
    let refused = import(wrong.as_bytes(), "ply", 1.0).expect_err("no vertex");
    assert!(
        refused
            .to_string()
            .contains("-2 is not the number of a vertex"),
        "{refused}"
    );
}

#[test]
fn face_outlines_of_an_obj_are_faces_and_free_form_surfaces_are_counted() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let surface = "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 4 3\nparm u 0 0 1 1\nend\n";
    let outline = import(format!("{square}fo 1 2 3 4\n").as_bytes(), "obj", 1.0);
    let outline = outline.expect("a face");
    assert_eq!(
        (outline.triangles().len(), outline.dropped().total()),
        (2, 0)
    );
    let both = import(format!("{square}f 1 2 3\n{surface}").as_bytes(), "obj", 1.0);
    assert_eq!(
        both.expect("a face").dropped().to_string(),
        "1 face left out (0 not finite, 0 without area, 0 duplicate, 1 free-form surfaces, which are not read)"
    );
    let alone = import(format!("{square}{surface}").as_bytes(), "obj", 1.0);
    assert_eq!(
        alone.map(|_| ()),
        Err(ImportError::FreeForm { surfaces: 1 })
    );
}
