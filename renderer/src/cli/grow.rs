//! `lamina grow`: a leaf's veins, blade and contents as files.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use leafmodel::leaf::Leaf;
use serde_json::json;

use crate::cli::arguments::GrowArguments;
use crate::cli::{Failure, check_writable, say, stats};
use crate::export::mitsuba::map_picture;
use crate::image::{atomic, openexr};
use crate::material::contents_texture::ContentsTexture;
use crate::scene::load;

pub(super) fn run(arguments: &GrowArguments) -> Result<(), Failure> {
    let started = Instant::now();
    let (file, wanted) = arguments.file_and_leaf();
    let leaves = load::load_leaves(&file, &arguments.overrides)?;
    let names: Vec<&str> = leaves.iter().map(|leaf| leaf.name.as_str()).collect();
    let chosen = match wanted {
        None if leaves.len() == 1 => leaves.first(),
        None => None,
        Some(name) => leaves.iter().find(|leaf| leaf.name == name),
    };
    let Some(chosen) = chosen else {
        return Err(Failure::bad(format!(
            "{} holds the leaves {}: name one of them behind the file, as in {}#{}",
            file.display(),
            names.join(", "),
            file.display(),
            names.first().unwrap_or(&"NAME")
        )));
    };
    for path in arguments.out.iter().chain(&arguments.stats) {
        check_writable(path)?;
    }
    for path in &arguments.out {
        kind_of(path)?;
    }
    let mut plan = chosen.value.plan.clone();
    plan.seed = arguments.seed.unwrap_or(plan.seed);
    let leaf = Leaf::grow(&plan).map_err(Failure::bad)?;
    for path in &arguments.out {
        let bytes = match kind_of(path)? {
            Kind::Svg => svg(&leaf).into_bytes(),
            Kind::Ply => ply(&leaf),
            Kind::Obj => obj(&leaf).into_bytes(),
        };
        atomic::replace(path, |file| file.write_all(&bytes)).map_err(Failure::system)?;
        say(path.display());
    }
    if let Some(folder) = &arguments.contents {
        std::fs::create_dir_all(folder)
            .map_err(|error| Failure::system(format!("{}: {error}", folder.display())))?;
        let path = folder.join(format!("{}.exr", chosen.name));
        let map = &leaf.contents;
        let texture =
            ContentsTexture::new(map.width as usize, map.height as usize, map.texels.clone());
        openexr::write(&map_picture(&texture), &path).map_err(Failure::system)?;
        say(path.display());
    }
    let seconds = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.stats {
        let report = json!({
            "leaf": chosen.name,
            "seconds": seconds,
            "peak_mib": stats::peak_mib(),
            "nodes": leaf.network.nodes().len(),
            "loops": leaf.network.loops(),
            "steps": leaf.network.steps(),
            "triangles": leaf.mesh.triangles.len(),
        });
        stats::write(path, &report)?;
    }
    eprintln!(
        "{}: {} vein nodes, {} loops, {} triangles, {seconds:.2} s",
        chosen.name,
        leaf.network.nodes().len(),
        leaf.network.loops(),
        leaf.mesh.triangles.len()
    );
    Ok(())
}

enum Kind {
    Svg,
    Ply,
    Obj,
}

fn kind_of(path: &Path) -> Result<Kind, Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("svg") => Ok(Kind::Svg),
        Some("ply") => Ok(Kind::Ply),
        Some("obj") => Ok(Kind::Obj),
        _ => Err(Failure::bad(format!(
            "{}: the ending tells what is written, svg (veins), ply or obj (blade)",
            path.display()
        ))),
    }
}

/// Margin and veins in their true widths, millimetres, apex up.
fn svg(leaf: &Leaf) -> String {
    let (min, size) = (leaf.frame.min, leaf.frame.size);
    let border = 0.02 * size.y;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n\
         <g transform=\"scale(1,-1)\">\n<path fill=\"#eef3e2\" stroke=\"none\" d=\"",
        size.x + 2.0 * border,
        size.y + 2.0 * border,
        min.x - border,
        -(min.y + size.y + border)
    );
    for (number, point) in leaf.outline.points().iter().enumerate() {
        let letter = if number == 0 { 'M' } else { 'L' };
        let _ = write!(text, "{letter}{:.4} {:.4}", point.x, point.y);
    }
    text += "Z\"/>\n<g stroke=\"#3c5a2a\" stroke-linecap=\"round\" fill=\"none\">\n";
    for vein in leaf.network.segments() {
        let _ = writeln!(
            text,
            "<path stroke-width=\"{:.4}\" d=\"M{:.4} {:.4}L{:.4} {:.4}\"/>",
            vein.radius_from + vein.radius_to,
            vein.from.x,
            vein.from.y,
            vein.to.x,
            vein.to.y
        );
    }
    text + "</g>\n</g>\n</svg>\n"
}

/// The blade in millimetres, with normals, uv and thickness.
fn ply(leaf: &Leaf) -> Vec<u8> {
    let mesh = &leaf.mesh;
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment lengths in mm\nelement vertex {}\n",
        mesh.positions.len()
    );
    for name in ["x", "y", "z", "nx", "ny", "nz", "u", "v", "thickness"] {
        let _ = writeln!(header, "property float {name}");
    }
    let _ = write!(
        header,
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    for (vertex, position) in mesh.positions.iter().enumerate() {
        let normal = mesh.normals[vertex];
        let uv = mesh.uvs[vertex];
        let thickness = mesh.thickness_mm[vertex];
        for value in position
            .to_array()
            .into_iter()
            .chain(normal.to_array())
            .chain([uv.x, uv.y, thickness])
        {
            bytes.extend_from_slice(&(value as f32).to_le_bytes());
        }
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        for index in triangle {
            bytes.extend_from_slice(&(*index as i32).to_le_bytes());
        }
    }
    bytes
}

fn obj(leaf: &Leaf) -> String {
    let mesh = &leaf.mesh;
    let mut text = String::from("# lengths in mm\n");
    for (vertex, position) in mesh.positions.iter().enumerate() {
        let (normal, uv) = (mesh.normals[vertex], mesh.uvs[vertex]);
        let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
        let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
        let _ = writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z);
    }
    for [a, b, c] in mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|index| index + 1))
    {
        let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
    }
    text
}
