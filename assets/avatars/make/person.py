"""The people: which shape targets make each body, and what each wears.

Shares of MakeHuman's macro targets, then its modelling targets ("cheek/l-cheek-bones-out": 0.2; a name
without side, "cheek/*-cheek-bones-out", stands for both).
"""

from dataclasses import dataclass, field

from . import lips

ORIGINS = ("caucasian", "african", "asian")

# MakeHuman's face at rest looks stern: brows are low and lips are pressed. Chosen among ten mixtures by looking.
# The second male has his own: in blind ratings of how sad he looks it got 3 of 7, and this mixture 4.
CALM = {2: 0.20, 4: -0.30, 5: 0.15, 12: 0.12}


@dataclass
class Person:
    name: str
    female: float  # share of the female macro targets; the rest is male
    origins: dict  # share of each of ORIGINS, sum 1
    height: float  # -1 shortest .. 1 tallest
    muscle: float  # 0 average .. 1 most
    weight: float  # -1 least .. 1 most, 0 average
    age: float = 0.0  # 0: about 25 years old .. 1: about 90
    shape: dict = field(default_factory=dict)  # modelling target: weight
    calm: dict = field(default_factory=lambda: dict(CALM))  # action unit: share, added to the face at rest
    outfit: str = ""  # a clothes proxy
    shoes: str = "shoes03"
    hair: str = ""  # one of hair.STYLES
    brows: str = ""
    lashes: str = ""
    skins: dict = field(default_factory=dict)  # skin image: share
    colours: dict = field(default_factory=dict)  # sRGB


def _kinds(person):
    """((macro target's gender and age, share) ...)"""
    genders = (("female", person.female), ("male", 1 - person.female))
    ages = (("young", 1 - person.age), ("old", person.age))
    return [(f"{gender}-{age}", g * a) for gender, g in genders for age, a in ages]


def shape_weights(person):
    """Target name: weight, of the whole body."""
    weights = {}

    def add(name, weight):
        if weight:
            weights[name] = weights.get(name, 0) + weight

    heavier = "maxweight" if person.weight > 0 else "minweight"
    for kind, share in _kinds(person):
        for origin in ORIGINS:
            add(f"macrodetails/{origin}-{kind}", share * person.origins.get(origin, 0))
        for muscle, m in (("averagemuscle", 1 - person.muscle), ("maxmuscle", person.muscle)):
            for weight, w in (("averageweight", 1 - abs(person.weight)), (heavier, abs(person.weight))):
                build = f"{kind}-{muscle}-{weight}"
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
        hair="swept",
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
        origins={"caucasian": 0.65, "african": 0.05, "asian": 0.3},
        height=0.0,
        muscle=0.0,
        weight=-0.25,
        age=0.08,
        shape={"head/head-oval": 0.3, "measure/measure-shoulder-decrease": 0.3, "eyes/*-eye-size-big": 0.15},
        outfit="female_casualsuit01",
        hair="bob",
        brows="eyebrow001",
        lashes="Eyelashes01",
        skins={
            "young_caucasian_female/textures/young_lightskinned_female_diffuse.png": 0.5,
            "young_caucasian_female/textures/young_lightskinned_female_diffuse2.png": 0.5,
        },
        colours={
            "skin": (0.85, 0.66, 0.55),
            "lips": (0.74, 0.43, 0.40),
            "hair": (0.34, 0.22, 0.14),
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
        age=0.1,
        shape={"measure/measure-shoulder-decrease": 0.3, "torso/torso-scale-horiz-decr": 0.2, "chin/chin-width-max": 0.1},
        outfit="male_casualsuit04",
        hair="short",
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
    Person(
        name="female2",
        female=1.0,
        origins={"caucasian": 0.1, "african": 0.85, "asian": 0.05},
        height=0.05,
        muscle=0.1,
        weight=0.05,
        age=0.30,
        shape={"measure/measure-shoulder-decrease": 0.3, "head/head-oval": 0.2},
        outfit="female_casualsuit01",
        hair="bun",
        brows="eyebrow001",
        lashes="Eyelashes01",
        skins={
            "young_african_female/textures/young_darkskinned_female_diffuse.png": 0.5,
            "middleage_african_female/textures/middleage_darkskinned_female_diffuse.png": 0.5,
        },
        colours={
            "skin": (0.47, 0.31, 0.23),
            "lips": (0.47, 0.26, 0.23),
            "hair": (0.09, 0.07, 0.06),
            "shirt": (0.62, 0.56, 0.47),
            "trousers": (0.20, 0.21, 0.24),
            "shoes": (0.12, 0.11, 0.11),
            "iris": "brown_eye",
        },
    ),
    Person(
        name="male2",
        female=0.0,
        origins={"caucasian": 0.75, "african": 0.05, "asian": 0.2},
        height=0.0,
        muscle=0.1,
        weight=0.15,
        age=0.48,
        calm={2: 0.35, 4: -0.20, 5: 0.30, 12: 0.25},
        shape={"measure/measure-shoulder-decrease": 0.2, "head/head-rectangular": 0.2},
        outfit="male_casualsuit02",
        hair="receding",
        brows="eyebrow009",
        lashes="Eyelashes01",
        skins={
            "middleage_caucasian_male/textures/middleage_lightskinned_male_diffuse.png": 0.6,
            "old_caucasian_male/textures/old_lightskinned_male_diffuse.png": 0.4,
        },
        colours={
            "skin": (0.82, 0.63, 0.54),
            "lips": (0.70, 0.46, 0.42),
            "hair": (0.46, 0.44, 0.42),
            "shirt": (0.27, 0.33, 0.28),
            "trousers": (0.24, 0.23, 0.22),
            "shoes": (0.13, 0.11, 0.10),
            "iris": "grey_eye",
        },
    ),
]
