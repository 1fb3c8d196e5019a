//! Sweeps: one scene, or one leaf, with many settings.
//!
//! - **In**: a sweep file ([`Sweep::file`]), or words `KEY=a,b,c` of a command line
//!   ([`Sweep::words`]).
//! - **Out**: the tasks, each a list of settings `key=value` as overrides are written.
//! - **Always true**: no key is varied twice, every number is finite, there is at least one task.
//!   Which settings task number `i` has depends on nothing but the sweep.
//! - **Left out**: what a key may be set to, which the swept file knows, and what is done with a
//!   task, which the command line does.
//!
//! ```
//! use renderer::sweep::{Sweep, Target, Words};
//!
//! let over = ["film.rgb.spp=16,64", "lights.sun.distant.elevation_deg=10..50/3"];
//! let words = Words { over: &over.map(str::to_owned), ..Words::default() };
//! let sweep = Sweep::words(Target::Scene("scene.toml".into()), "scene.toml", &words)?;
//! assert_eq!(sweep.len(), 6);
//! let last = sweep.task(5);
//! let settings: Vec<String> = last.overrides().collect();
//! assert_eq!(settings, ["film.rgb.spp=64", "lights.sun.distant.elevation_deg=50"]);
//! # Ok::<(), leafmodel::document::report::DocumentErrors>(())
//! ```

mod blame;
mod draft;
mod file;
mod latin;
mod range;
mod rows;
mod tasks;
mod values;
mod words;

pub use self::blame::Refused;
pub use self::file::is_sweep_file;
pub use self::tasks::{Sweep, Target, Task};
pub use self::values::{Cell, Key, MOST_TASKS};
pub use self::words::Words;

#[cfg(test)]
mod tests;
