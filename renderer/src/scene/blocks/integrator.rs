//! `[integrator]`.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Flag, Integer, Number};

use crate::sampling::dimensions::MOST_EVENTS;
use crate::scene::description::Integrator;

/// The keys of `[integrator]`.
pub(super) fn integrator(integrator: &mut Integrator, keys: &mut Keys<'_>) {
    let count = Integer::within(1, 100_000);
    let about = "Most scattering events of a path. A limit darkens the picture: in the infrared, \
        where leaves hardly absorb, a limit of 8 loses some 2 %. How many paths it cuts is reported.";
    keys.optional("max_depth", &mut integrator.max_depth, count, about);
    let count = Integer::within(1, u64::from(MOST_EVENTS));
    let about = "Events after which a path is cut, in pictures and in instruments: scatterings, \
        flights through media, and ways between scatterings in a leaf of layers. It is for light \
        that is caught. How many paths were cut is reported, and how much light that may lose.";
    keys.key("max_events", &mut integrator.max_events, count, about);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "Paths of whose light less than this share can reach the film may end by Russian \
        roulette, without bias; 0 switches it off. On a film of colour the share is what the eye \
        sees, on bands their mean, at least a quarter of the brightest. Higher is faster and noisier.";
    keys.optional(
        "roulette_below",
        &mut integrator.roulette_below,
        limits,
        about,
    );
    let count = Integer::within(1, 64);
    let about = "Paths that go on from what the camera sees first, where none of the lights that \
        are sampled (suns, lamps, sky pictures) reaches it. More is slower and less noisy, in \
        shade.";
    keys.optional("branches", &mut integrator.branches, count, about);
    let about = "Paths that go on from there where such a light reaches it. More is slower and \
        less noisy, above all close to leaves in the sun.";
    keys.optional("lit_branches", &mut integrator.lit_branches, count, about);
    let about = "Samples of lamps and sky pictures at what the camera sees first; suns have one \
        each. More is slower and less noisy where lamps cast soft shadows.";
    keys.optional("light_samples", &mut integrator.light_samples, count, about);
    let about = "Whether skies and environment pictures are sampled as lamps are; if not, paths find \
        them where they leave the scene. Without is faster, and noisier where little of a sky \
        sends much of its light.";
    keys.optional("sample_skies", &mut integrator.sample_skies, Flag, about);
}
