//! Films: of a leaf that grows or ages, and of a scene that is rendered with rising values.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::AtomicBool;

use tempfile::NamedTempFile;

use super::outputs::{Kind, finish};
use crate::cli::progress::Steps;
use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::drawing::Drawing;
use crate::image::animation::{Animation, Timing};
use crate::image::atomic::folder_of;

/// The program that makes mp4; nothing else needs it.
const ENCODER: &str = "ffmpeg";

/// Fails if a film needs a program that is not there.
pub(in crate::cli) fn check(files: &[(PathBuf, Kind)]) -> Result<(), Failure> {
    let Some((path, _)) = files.iter().find(|(_, kind)| *kind == Kind::Mp4) else {
        return Ok(());
    };
    let found = Command::new(ENCODER)
        .arg("-version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    match found {
        Ok(status) if status.success() => Ok(()),
        Ok(_) | Err(_) => Err(bad_at!(
            path,
            "mp4 is made by the program `{ENCODER}`, which cannot be run here: install it, or let the name end in gif or \
             apng, which need no other program"
        )),
    }
}

/// All films that are being written.
pub(in crate::cli) struct Films {
    all: Vec<GrowthFilm>,
    count: u32,
    /// Frames that are drawn.
    drawn: Steps,
    timing: Timing,
}

struct GrowthFilm {
    path: PathBuf,
    kind: Kind,
    /// There is one from the first frame on, which tells the size.
    writer: Option<FilmWriter>,
}

enum FilmWriter {
    /// Boxed, since it is far larger.
    Own(Box<Animation>),
    Other(FilmEncoding),
}

impl Films {
    /// The films among some files, each of `count` frames.
    pub(in crate::cli) fn begun(files: &[(PathBuf, Kind)], timing: Timing, count: u32) -> Self {
        let films = files.iter().filter(|(_, kind)| kind.is_film());
        let films = films.map(|(path, kind)| GrowthFilm {
            path: path.clone(),
            kind: *kind,
            writer: None,
        });
        Self {
            all: films.collect(),
            count,
            drawn: Steps::new("frames", count),
            timing,
        }
    }

    /// Number of frames of each.
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Adds frames to all films.
    pub(in crate::cli) fn push(&mut self, frames: &[Drawing]) -> Result<(), Failure> {
        let Some(first) = frames.first() else {
            return Ok(());
        };
        let size = [first.width, first.height];
        for film in &mut self.all {
            let writer = if let Some(writer) = &mut film.writer {
                writer
            } else {
                let begun = FilmWriter::begun(film.kind, &film.path, size, self.count, self.timing);
                film.writer.insert(begun?)
            };
            match writer {
                FilmWriter::Own(film) => {
                    let pixels: Vec<&[u8]> = frames.iter().map(|frame| &frame.rgb[..]).collect();
                    film.push(&pixels).map_err(Failure::bad)?;
                }
                FilmWriter::Other(encoding) => {
                    for frame in frames {
                        encoding.push(&frame.rgb)?;
                    }
                }
            }
        }
        self.drawn.add(frames.len());
        Ok(())
    }

    /// Writes the files.
    pub(in crate::cli) fn finish(self, stop: &AtomicBool) -> Result<(), Failure> {
        for film in self.all {
            let Some(writer) = film.writer else { continue };
            let bytes = match writer {
                FilmWriter::Own(film) => film.finish().map_err(Failure::bad)?,
                FilmWriter::Other(encoding) => encoding.finish(self.timing, stop)?,
            };
            finish(&film.path, &bytes, stop)?;
        }
        Ok(())
    }
}

impl FilmWriter {
    fn begun(
        kind: Kind,
        path: &Path,
        size: [u32; 2],
        count: u32,
        timing: Timing,
    ) -> Result<Self, Failure> {
        let Kind::Film(format) = kind else {
            return Ok(Self::Other(FilmEncoding::begun(path, size, timing)?));
        };
        let film = Animation::new(format, size, count, timing).map_err(Failure::bad)?;
        Ok(Self::Own(Box::new(film)))
    }
}

/// A run of the other program, which takes frames and writes to a file that nobody sees yet.
struct FilmEncoding {
    child: Child,
    file: NamedTempFile,
    /// Shown once more at the end.
    last: Vec<u8>,
}

impl FilmEncoding {
    fn begun(path: &Path, [width, height]: [u32; 2], timing: Timing) -> Result<Self, Failure> {
        let file = tempfile::Builder::new()
            .prefix(&format!(".lamina-{}-", std::process::id()))
            .suffix(".part")
            .tempfile_in(folder_of(path))
            .map_err(Failure::system)?;
        let mut command = Command::new(ENCODER);
        // Ctrl-C is for this program, which ends that one.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let child = command
            .args(["-nostdin", "-loglevel", "error", "-y"])
            .args(["-f", "rawvideo", "-pixel_format", "rgb24"])
            .args(["-video_size", &format!("{width}x{height}")])
            .args(["-framerate", &timing.frames_per_second.to_string()])
            .args(["-i", "-"])
            // Players want even sides, and two colour values for four pixels.
            .args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"])
            .args([
                "-pix_fmt",
                "yuv420p",
                "-movflags",
                "+faststart",
                "-f",
                "mp4",
            ])
            .arg(file.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| Failure::system(format!("{ENCODER}: {error}")))?;
        Ok(Self {
            child,
            file,
            last: Vec::new(),
        })
    }

    fn push(&mut self, rgb: &[u8]) -> Result<(), Failure> {
        if !self.last.is_empty() && self.last.len() != rgb.len() {
            bail!("a frame of another size than its film");
        }
        self.send(rgb)?;
        rgb.clone_into(&mut self.last);
        Ok(())
    }

    fn send(&mut self, rgb: &[u8]) -> Result<(), Failure> {
        let sent = self.child.stdin.as_mut().map(|pipe| pipe.write_all(rgb));
        match sent {
            Some(Ok(())) => Ok(()),
            // It has ended before its time and says why.
            Some(Err(_)) | None => Err(self.failure()),
        }
    }

    fn finish(mut self, timing: Timing, stop: &AtomicBool) -> Result<Vec<u8>, Failure> {
        let again = (timing.last_frame_seconds * timing.frames_per_second).round() - 1.0;
        let last = std::mem::take(&mut self.last);
        for _ in 0..again.max(0.0) as u32 {
            signals::check(stop)?;
            self.send(&last)?;
        }
        let failure = self.failure();
        let status = self.child.wait().map_err(Failure::system)?;
        if !status.success() {
            return Err(failure);
        }
        std::fs::read(self.file.path()).map_err(Failure::system)
    }

    /// Why it has failed, if it has: waits until it has nothing more to say.
    fn failure(&mut self) -> Failure {
        drop(self.child.stdin.take());
        let mut said = String::new();
        if let Some(mut pipe) = self.child.stderr.take() {
            let _ = pipe.read_to_string(&mut said);
        }
        let why = match said.trim() {
            "" => "it does not say why",
            said => said,
        };
        Failure::system(format!("{ENCODER} failed: {why}"))
    }
}

impl Drop for FilmEncoding {
    fn drop(&mut self) {
        // After a failure or Ctrl-C it must not go on.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
