"""Textures: skin with lips and fine mottling, hair and brows in a colour of our own, cloth."""

import io

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

SKIN_SIZE = 2048
LUMA = np.array([0.299, 0.587, 0.114])


def png(rgba):
    data = io.BytesIO()
    Image.fromarray(np.round(np.clip(rgba, 0, 1) * 255).astype(np.uint8)).save(data, "PNG", optimize=True)
    return ("image/png", data.getvalue())


def jpeg(rgb, quality=88, full_colour=False):
    """`full_colour`: red and blue as sharp as the rest, for numbers that are no colours."""
    data = io.BytesIO()
    bytes_ = np.round(np.clip(rgb[..., :3], 0, 1) * 255).astype(np.uint8)
    Image.fromarray(bytes_).save(data, "JPEG", quality=quality, optimize=True, subsampling=0 if full_colour else -1)
    return ("image/jpeg", data.getvalue())


def resized(image, size):
    """(size, size, C) bicubic."""
    planes = [
        np.asarray(Image.fromarray(image[..., c].astype(np.float32), "F").resize((size, size), Image.BICUBIC))
        for c in range(image.shape[2])
    ]
    return np.clip(np.stack(planes, -1).astype(float), 0, 1)


def mottling(size, seed):
    """(size, size) noise of three coarsenesses, mean 0, deviation about 1."""
    random = np.random.RandomState(seed)
    total = np.zeros((size, size))
    for blur, share in ((1.0, 0.5), (4.0, 0.6), (18.0, 0.5)):
        noise = gaussian_filter(random.standard_normal((size, size)), blur, mode="wrap")
        total += share * noise / noise.std()
    return total / total.std()


# Where things lie in MakeHuman's skin layout, u and v up.
LIPS_BOX = (0.885, 0.935, 0.455, 0.51)
EYES_BOX = (0.815, 0.868, 0.41, 0.56)
HANDS_BOX = (0.355, 0.785, 0.0, 0.21)
MOUTH_BOX = (0.74, 0.94, 0.0, 0.15)
CHEEKS = ((0.865, 0.55), (0.865, 0.415))


def _box(image, box):
    size = len(image)
    u0, u1, v0, v1 = box
    return slice(int((1 - v1) * size), int((1 - v0) * size)), slice(int(u0 * size), int(u1 * size))


def skin(sources, person):
    """(SKIN_SIZE, SKIN_SIZE, 3) sRGB. `sources` (512, 512, 3) is the mean of the skins it is made of."""
    image = resized(sources, SKIN_SIZE)
    # The cheeks get the wanted colour, everything else its ratio to them.
    cheeks = np.mean([image[_around(u, v)].mean((0, 1)) for u, v in CHEEKS], axis=0)
    image = image * (np.array(person.colours["skin"]) / cheeks)
    image = _clear_lids(image, np.array(person.colours["skin"]))
    image = _redden_lips(image, np.array(person.colours["lips"]))
    image = _warm_palms(image, np.array(person.colours["skin"]))
    grain = mottling(SKIN_SIZE, 11)[..., None]
    tint = np.array([0.010, 0.013, 0.014])  # blood shows more in green and blue
    return np.clip(image * (1 + grain * tint), 0, 1)


def _around(u, v, reach=0.01):
    return _box(np.empty((SKIN_SIZE, 0)), (u - reach, u + reach, v - reach, v + reach))


def _clear_lids(image, skin_colour):
    """Takes half of the painted shadow and redness off the lids: the light makes its own."""
    rows = _box(image, EYES_BOX)
    part = image[rows]
    ratio = np.clip((part @ LUMA) / (skin_colour @ LUMA), 0.3, 1)[..., None]
    plain = skin_colour * ratio**0.4
    height, width = part.shape[:2]
    y, x = np.mgrid[:height, :width]
    edge = np.minimum(np.minimum(x, width - 1 - x) / (0.25 * width), np.minimum(y, height - 1 - y) / (0.15 * height))
    image[rows] = part + 0.6 * np.clip(edge, 0, 1)[..., None] * (plain - part)
    return image


def _redden_lips(image, colour):
    rows = _box(image, LIPS_BOX)
    part = image[rows]
    red = part[..., 0] - 0.5 * (part[..., 1] + part[..., 2])
    low, high = np.percentile(red, 45), np.percentile(red, 92)
    mask = np.clip((red - low) / (high - low), 0, 1)[..., None]
    luma = part @ LUMA
    wanted = colour * (luma / np.median(luma[mask[..., 0] > 0.6]))[..., None]
    image[rows] = part + 0.75 * mask * (wanted - part)
    return image


def _warm_palms(image, skin_colour):
    """Palms are lighter than the cheeks by 0.7 of what is painted, in the colour of the skin, with soft edges."""
    rows = _box(image, HANDS_BOX)
    part = image[rows]
    luma = part @ LUMA
    lighter = np.maximum(gaussian_filter(luma, 3) / (skin_colour @ LUMA) - 1, 0)[..., None]
    palm = skin_colour * (1 + 0.7 * lighter) * (luma / gaussian_filter(luma, 3))[..., None]
    image[rows] = part + np.minimum(4 * lighter, 0.75) * (palm - part)
    return image


# The inside of a mouth, which MakeHuman's skins paint from bright red to nearly black: its colour behind the lips, [m]
# over which lips become it, [m] where it begins to get darker towards the throat, over which depth, and what is left.
# Ours, by eye on five people with the jaw dropped.
MUCOSA = np.array([0.62, 0.31, 0.29])
LIPS_END, THROAT_FROM, THROAT_DEEP, THROAT_LEFT = 0.008, 0.025, 0.045, 0.25


def mouth(image, places, lips):
    """The skin's texture with the inside of the mouth painted alike for all; `places` (H, W, 3) [m] of its texels, nan
    elsewhere."""
    rows = _box(image, MOUTH_BOX)
    known = np.isfinite(places[rows][..., 0])
    depth = places[rows][..., 2][known]
    depth = depth.max() - depth
    share = np.clip(depth / LIPS_END, 0, 1)[:, None]
    light = 1 - (1 - THROAT_LEFT) * np.clip((depth - THROAT_FROM) / THROAT_DEEP, 0, 1)[:, None]
    image = image.copy()
    image[rows][known] = (lips + share * (MUCOSA - lips)) * light
    return image


def recoloured(rgba, colour, contrast=1.0, alpha_gain=1.0):
    """(H, W, 4) the light and dark of an image in another colour; clear parts take the colour too, so that no fringe
    shows where the image is filtered."""
    alpha = np.clip(rgba[..., 3] * alpha_gain, 0, 1)
    luma = rgba[..., :3] @ LUMA
    solid = alpha > 0.5
    middle = luma[solid].mean() + 1e-3
    shade = np.where(solid, luma / middle, 1.0)
    shade = np.clip(1 + contrast * (shade - 1), 0.3, 1.7)
    return np.concatenate([np.array(colour) * shade[..., None], alpha[..., None]], -1)


def cloth(shadow, folds, colour, weave, seed):
    """(H, W, 3) a plain cloth: `shadow` (H, W) how open it lies, `folds` (H, W) light and dark about 1."""
    size = len(shadow)
    grain = mottling(size, seed)
    y, x = np.mgrid[:size, :size]
    threads = np.sin(x * np.pi / 2) * np.sin(y * np.pi / 2) if weave else 0
    shade = folds * (0.55 + 0.45 * shadow) * (1 + 0.02 * grain + 0.02 * threads)
    return np.array(colour) * shade[..., None]
