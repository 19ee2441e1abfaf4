"""Head and neck: a brow, a nose and a chin show the front; there is no face."""

from .shapes import FRONT, Blend, Ellipsoid, Frame, Loft, Paired, add, ball, carve, strand, upright


def neck():
    frame = Frame([0, 1.395, -0.040], [0, 1, 0.23], FRONT)
    rows = [
        (0.000, 0, 0, 0.068, 0.068, 0.058, 0.058),
        (0.045, 0, 0, 0.0535, 0.0535, 0.0545, 0.0550),
        (0.090, 0, 0, 0.0500, 0.0500, 0.0535, 0.0530),
        (0.140, 0, 0, 0.0495, 0.0495, 0.0535, 0.0520),
        (0.200, 0, 0, 0.0500, 0.0500, 0.0500, 0.0540),
    ]
    turner = strand(((0.054, 1.572, -0.016), 0.012), ((0.036, 1.495, 0.008), 0.011), ((0.012, 1.410, 0.018), 0.009))
    return Blend(add(Loft(frame, rows, caps=(0.03, 0.03))), add(Paired(turner, 0.008), 0.026))


def nose():
    frame = Frame([0, 1.640, 0.080], [0, -1, 0.27], FRONT)
    rows = [
        (0.000, 0, 0, 0.0080, 0.0080, 0.0095, 0.02),
        (0.020, 0, 0, 0.0075, 0.0075, 0.0115, 0.02),
        (0.038, 0, 0, 0.0100, 0.0100, 0.0145, 0.02),
        (0.044, 0, 0, 0.0118, 0.0118, 0.0148, 0.02),
    ]
    return Loft(frame, rows, power=1.8, caps=(0.030, 0.019))


def ear():
    along, front = [0.12, 1, -0.20], [-0.42, 0, 1]
    shell = ball([0.0725, 1.600, -0.006], (0.0300, 0.0078, 0.0170), along, front)
    hollow = ball([0.0820, 1.603, 0.001], (0.0175, 0.0050, 0.0085), along, front)
    return Blend(add(shell), carve(hollow, 0.008))


def head():
    cranium = Ellipsoid(upright([0, 1.6320, 0.002]), (0.0880, 0.0750, 0.0950), power=2.1)
    face = Ellipsoid(Frame([0, 1.5790, 0.0315], (0, 1, -0.05), FRONT), (0.0800, 0.0580, 0.0640), power=2.15)
    cheekbone = ball([0.038, 1.592, 0.036], (0.026, 0.024, 0.030))
    jaw = strand(((0.014, 1.518, 0.056), 0.013), ((0.040, 1.540, 0.012), 0.011), ((0.048, 1.570, -0.004), 0.012))
    chin = ball([0, 1.521, 0.070], (0.015, 0.015, 0.015))
    mouth_volume = ball([0, 1.550, 0.072], (0.022, 0.030, 0.016))
    eye_socket = ball([0.034, 1.617, 0.1235], (0.018, 0.032, 0.027))
    return Blend(
        add(cranium),
        add(face, 0.022),
        add(Paired(cheekbone, 0.012), 0.035),
        add(Paired(jaw, 0.010), 0.030),
        add(chin, 0.032),
        add(mouth_volume, 0.034),
        carve(Paired(eye_socket, 0.004), 0.020),
        add(nose(), 0.012),
        add(ear(), 0.013),
    )
