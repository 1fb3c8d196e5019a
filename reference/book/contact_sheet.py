"""Pictures joined into one sheet for the book."""

import pathlib

import numpy as np
import OpenImageIO as oiio


def pixels(file: pathlib.Path) -> np.ndarray:
    """A picture's pixels (height, width, 3), 0 to 255, on white where it is transparent."""
    read = oiio.ImageBuf(str(file)).get_pixels(oiio.UINT8)
    if read.shape[2] < 4:
        return read[:, :, :3]
    alpha = read[:, :, 3:].astype(float) / 255
    return np.rint(read[:, :, :3] * alpha + 255 * (1 - alpha)).astype(np.uint8)


def centred(picture: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """A picture in the middle of a white field (height, width) that holds it."""
    field = np.full((*size, 3), 255, np.uint8)
    top, left = ((outer - inner) // 2 for outer, inner in zip(size, picture.shape[:2], strict=True))
    field[top : top + picture.shape[0], left : left + picture.shape[1]] = picture
    return field


def tile(rows: list[list[np.ndarray]], out: pathlib.Path) -> None:
    """Writes pictures in rows as one JPEG."""
    whole = np.vstack([np.hstack(row) for row in rows])
    spec = oiio.ImageSpec(whole.shape[1], whole.shape[0], 3, oiio.UINT8)
    spec.attribute("compression", "jpeg:82")
    joined = oiio.ImageBuf(spec)
    joined.set_pixels(oiio.ROI(), np.ascontiguousarray(whole))
    joined.write(str(out))
