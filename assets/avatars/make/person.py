"""The three persons: which shape targets make each body, and what each wears.

Shares of MakeHuman's macro targets, then its modelling targets ("cheek/l-cheek-bones-out": 0.2; a name
without side, "cheek/*-cheek-bones-out", stands for both).
"""

from dataclasses import dataclass, field

from . import lips

ORIGINS = ("caucasian", "african", "asian")


@dataclass
class Person:
    name: str
    female: float  # share of the female macro targets; the rest is male
    origins: dict  # share of each of ORIGINS, sum 1
    height: float  # -1 shortest .. 1 tallest
    muscle: float  # 0 average .. 1 most
    weight: float  # -1 least .. 1 most, 0 average
    shape: dict = field(default_factory=dict)  # modelling target: weight
    outfit: str = ""  # a clothes proxy
    shoes: str = "shoes03"
    hair: str = ""
    brows: str = ""
    lashes: str = ""
    skins: dict = field(default_factory=dict)  # skin image: share
    colours: dict = field(default_factory=dict)  # sRGB


def _genders(person):
    return (("female", person.female), ("male", 1 - person.female))


def shape_weights(person):
    """Target name: weight, of the whole body."""
    weights = {}

    def add(name, weight):
        if weight:
            weights[name] = weights.get(name, 0) + weight

    heavier = "maxweight" if person.weight > 0 else "minweight"
    for gender, share in _genders(person):
        for origin in ORIGINS:
            add(f"macrodetails/{origin}-{gender}-young", share * person.origins.get(origin, 0))
        for muscle, m in (("averagemuscle", 1 - person.muscle), ("maxmuscle", person.muscle)):
            for weight, w in (("averageweight", 1 - abs(person.weight)), (heavier, abs(person.weight))):
                build = f"{gender}-young-{muscle}-{weight}"
                add(f"macrodetails/universal-{build}", share * m * w)
                taller = "maxheight" if person.height > 0 else "minheight"
                add(f"macrodetails/height/{build}-{taller}", share * m * w * abs(person.height))
                add(f"macrodetails/proportions/{build}-idealproportions", share * m * w * 0.25)
    for name, weight in person.shape.items():
        for side in "lr" if "*" in name else "-":
            add(name.replace("*", side), weight)
    return weights


def shaped(package, person):
    """(V, 3) [m] the base mesh with the body of a person, soles not yet on the floor."""
    points = package.base.points.copy()
    for name, weight in shape_weights(person).items():
        points += weight * package.target(name)
    points = lips.closed(package, points)
    return (points + package.mirrored(points)) / 2


PERSONS = [
    Person(
        name="neutral",
        female=0.5,
        origins={"caucasian": 0.4, "african": 0.25, "asian": 0.35},
        height=0.05,
        muscle=0.1,
        weight=-0.15,
        shape={"head/head-oval": 0.2, "measure/measure-shoulder-decrease": 0.35, "torso/torso-scale-horiz-decr": 0.25},
        outfit="male_casualsuit02",
        hair="short01",
        brows="eyebrow001",
        lashes="Eyelashes01",
        skins={
            "young_caucasian_female/textures/young_lightskinned_female_diffuse2.png": 0.5,
            "young_asian_male/textures/young_lightskinned_male_diffuse3.png": 0.5,
        },
        colours={
            "skin": (0.80, 0.62, 0.51),
            "lips": (0.70, 0.42, 0.38),
            "hair": (0.22, 0.15, 0.11),
            "shirt": (0.33, 0.40, 0.47),
            "trousers": (0.20, 0.22, 0.26),
            "shoes": (0.12, 0.12, 0.13),
            "iris": "brown_eye",
        },
    ),
    Person(
        name="female",
        female=1.0,
        origins={"caucasian": 0.6, "african": 0.1, "asian": 0.3},
        height=0.0,
        muscle=0.0,
        weight=-0.25,
        shape={"head/head-oval": 0.3, "measure/measure-shoulder-decrease": 0.3},
        outfit="female_casualsuit01",
        hair="ponytail01",
        brows="eyebrow001",
        lashes="Eyelashes01",
        skins={
            "young_caucasian_female/textures/young_lightskinned_female_diffuse.png": 0.5,
            "young_caucasian_female/textures/young_lightskinned_female_diffuse2.png": 0.5,
        },
        colours={
            "skin": (0.85, 0.66, 0.55),
            "lips": (0.74, 0.40, 0.38),
            "hair": (0.26, 0.185, 0.135),
            "shirt": (0.24, 0.38, 0.37),
            "trousers": (0.22, 0.24, 0.30),
            "shoes": (0.13, 0.12, 0.12),
            "iris": "grey_eye",
        },
    ),
    Person(
        name="male",
        female=0.0,
        origins={"caucasian": 0.5, "african": 0.3, "asian": 0.2},
        height=0.0,
        muscle=0.25,
        weight=-0.1,
        shape={"measure/measure-shoulder-decrease": 0.3, "torso/torso-scale-horiz-decr": 0.2},
        outfit="male_casualsuit04",
        hair="short02",
        brows="eyebrow009",
        lashes="Eyelashes01",
        skins={
            "young_caucasian_male/textures/young_lightskinned_male_diffuse2.png": 0.6,
            "young_african_male/textures/young_darkskinned_male_diffuse.png": 0.4,
        },
        colours={
            "skin": (0.70, 0.51, 0.40),
            "lips": (0.60, 0.38, 0.34),
            "hair": (0.13, 0.10, 0.08),
            "shirt": (0.40, 0.42, 0.44),
            "trousers": (0.19, 0.21, 0.25),
            "shoes": (0.14, 0.12, 0.11),
            "iris": "brownlight_eye",
        },
    ),
]
