"""Scenes of the repository against the committed schema."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import jsonschema_rs

ROOT = Path(__file__).resolve().parents[2]


# Broken scenes that a schema cannot tell from good ones: numbers that do not go together, names
# and files that are not there, curves that cross themselves. Ascending.
BEYOND_A_SCHEMA = """
    area_light bands camera_at_itself camera_upside colours_of_mesh compound_bipinnate
    compound_overlap compound_pair compound_palmate compound_palmate_round coverage dark_light
    energy file_missing foliage_bright growth_arrival growth_steps instances_flood instances_rows
    leaf_individual lens_angle lens_behind lens_blades lens_magnification lens_near lens_object
    lens_tilt matrix model mosaic_shares no_light outline_cubic_crossing outline_curve_crossing
    outline_curve_end outline_growth_crossing outline_growth_crossing_axis outline_specimen_inside
    outline_specimen_nested outline_specimen_notch outline_svg_crossing outline_svg_end
    outline_svg_parts outline_teeth_crossing outline_transport_cells path_outside picture_infrared
    plant_climbs_on_many plant_days plant_flower plant_leaf plant_order plant_pot plant_relief
    plant_room plant_shines plant_wall realisations scatter_days scatter_effect scatter_order
    senescence_auxin sensitivities_file sensor_file sensor_width solid_mesh solid_mosaic
    surface_cells surface_stomata table_file unknown_name unsorted venation_agrophic
    venation_cells venation_craspedodromous venation_origin venation_origins_meet venation_pairs
    venation_quaternaries venation_sinus venation_transport_fine venation_young white_light
    wilting_on_ground wrong_file yields
""".split()


def scene_schema() -> jsonschema_rs.Validator:
    """The schema that is committed."""
    text = (ROOT / "scenes" / "scene.schema.json").read_text()
    return jsonschema_rs.validator_for(json.loads(text))


def test_every_scene_of_the_repository_is_valid_by_the_schema() -> None:
    """An editor that goes by the schema finds no fault with them."""
    schema = scene_schema()
    scenes = sorted((ROOT / "scenes").glob("*/*.toml"))
    assert len(scenes) >= 20, scenes
    for scene in scenes:
        errors = list(schema.iter_errors(tomllib.loads(scene.read_text())))
        assert not errors, f"{scene}: {errors[0].message} at {errors[0].instance_path}"


def test_broken_scenes_are_refused_by_the_schema_as_far_as_one_can_tell() -> None:
    """Unknown keys, wrong types, ranges, missing keys and kinds."""
    schema = scene_schema()
    refused, passed = [], []
    for scene in sorted((ROOT / "tests" / "format" / "broken").glob("*.toml")):
        try:
            tree = tomllib.loads(scene.read_text())
        except (tomllib.TOMLDecodeError, UnicodeDecodeError):
            continue
        (passed if schema.is_valid(tree) else refused).append(scene.stem)
    unlisted, too_many = set(passed) - set(BEYOND_A_SCHEMA), set(BEYOND_A_SCHEMA) - set(passed)
    assert not unlisted, f"the schema finds no fault with {unlisted}, which BEYOND_A_SCHEMA lacks"
    assert not too_many, f"BEYOND_A_SCHEMA has {too_many}, which are refused or are not there"
    assert len(refused) >= 40, refused
