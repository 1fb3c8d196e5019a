"""Lamina from Python: it runs the program `lamina` and reads the files that it writes.

Nothing is computed a second time here; what a function returns is what the program wrote, as arrays
with units and coordinates.

    import lamina

    picture = lamina.render("scene.toml", {"film.spectral.spp": 256})
    leaf = lamina.grow("birch", {"seed": 3})
    spectra = lamina.optics(chlorophyll=45, water=0.011)
    figures = lamina.instruments("bench.toml", error=1e-3)["ball"]
    problems = lamina.check("scene.toml")
    pictures = lamina.sweep("sweep.toml", store="pictures.zarr")

The program is the one that the environment variable `LAMINA` names, else the one that was installed
with this package, else the one on the path, else cargo's release build of the repository that holds
this package.
"""

from lamina.checking import Problem, check
from lamina.envi import to_envi
from lamina.eradiate import to_eradiate
from lamina.grown import Grown, frames, grow
from lamina.measured import instruments, read_figures, to_netcdf
from lamina.parts import render_in_parts
from lamina.program import Folders, LaminaError, Value, program, run, version
from lamina.rendered import read, render
from lamina.scans import from_scans
from lamina.spectra import optics
from lamina.sweeping import sweep
from lamina.usd import to_usd

__all__ = [
    "Folders",
    "Grown",
    "LaminaError",
    "Problem",
    "Value",
    "check",
    "frames",
    "from_scans",
    "grow",
    "instruments",
    "optics",
    "program",
    "read",
    "read_figures",
    "render",
    "render_in_parts",
    "run",
    "sweep",
    "to_envi",
    "to_eradiate",
    "to_netcdf",
    "to_usd",
    "version",
]
