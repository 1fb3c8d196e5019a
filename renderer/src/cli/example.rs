//! `lamina example`: scenes that the program carries, written into a folder.

use std::fs;
use std::path::{Path, PathBuf};

use lamina_scenes::{SCENES, Scene};

use crate::cli::arguments::ExampleArguments;
use crate::cli::terminal::{Failure, say};
use crate::image::atomic::folder_of;

pub(super) fn run(arguments: &ExampleArguments) -> Result<(), Failure> {
    let Some(name) = &arguments.name else {
        let width = SCENES
            .iter()
            .map(|scene| scene.name.len())
            .max()
            .unwrap_or(0);
        for scene in SCENES {
            say(format!("{:<width$}  {}", scene.name, scene.about()));
        }
        return Ok(());
    };
    let scene = lamina_scenes::find(name).ok_or_else(|| {
        let known = SCENES.map(|scene| scene.name).join(", ");
        bad!("there is no example `{name}`; there are: {known}")
    })?;
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(scene.name));
    let shown = folder.display();
    if fs::symlink_metadata(&folder).is_ok() {
        bail!("{shown} exists: name another folder with --out");
    }
    write(scene, &folder).map_err(|error| Failure::system(format!("{shown}: {error}")))?;
    say(folder.join(scene.files[0].name).display());
    Ok(())
}

/// Makes the folder under a temporary name first, so that it is never there with half of its files.
fn write(scene: &Scene, folder: &Path) -> std::io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lamina-example-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    let temporary = builder.tempdir_in(folder_of(folder))?;
    for file in scene.files {
        fs::write(temporary.path().join(file.name), file.bytes)?;
    }
    fs::rename(temporary.path(), folder)?;
    // Under its new name the folder is nobody's to remove.
    let _ = temporary.keep();
    Ok(())
}
