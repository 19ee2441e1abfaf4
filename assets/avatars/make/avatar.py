"""Puts one avatar together: body, face, eyes, mouth, hair, clothes, rig, morphs, textures, file."""

import numpy as np
from PIL import Image
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from . import eyes, face, fitting, folds, glb, hair, hems, lids, paint, rig, surface
from . import person as persons


TEETH_BACK = 0.003  # [m] keeps them clear of closed lips
UPPER_TEETH_DOWN, LOWER_TEETH_UP = 0.0055, -0.0015  # [m] the upper ones reach over the lower ones
LOWER_TEETH_BACK = 0.0022  # [m] behind the upper ones
GUMS_BACK = 0.002  # [m] behind the teeth, whose necks they would else cover
TONGUE_SHIFT = (0, -0.0015, -0.010)  # [m] keeps it behind the teeth
# Cheeks shade the teeth behind the canines, so that the corners of a mouth are dark: how far behind the foremost tooth
# it begins, over which depth, and what is left. Ours, by eye on five people with lips parted, jaw dropped and smiling.
TEETH_LIT, TEETH_FADE, TEETH_DARK = 0.007, 0.015, 0.20  # [m], [m], share of light
TEETH_REDDEN = (1.0, 1.35, 1.45)  # powers of that share: light that is left has met the inside of the mouth
TEETH_SPECULAR = 0.1  # of a surface in the open, so that dark teeth do not shine like metal; ours, by eye
TONGUE_TINT = (1.05, 0.87, 0.85)  # its back is else a dull brown in an open mouth; ours, by eye
TONGUE_SPECULAR = 0.15  # as wet as it is, but in the shade of the mouth, which light from behind does not reach; ours
# Of a vertex whose normal is further forward than this, so that the backs of teeth are thinned; ours, by eye.
TEETH_FRONT_PRICE, TEETH_BACKWARD = 30.0, -0.4
TEETH_LIT_PRICE = 8.0  # that price times this for the teeth in front; ours, by eye
TEETH_WIDER = 0.06  # [share] so that they touch, and no dark slots are left between them; ours, by eye
TEETH_FROM, GUMS_FROM = 0.106, 0.088  # [m, base mesh] what lies behind is never seen


RIM_MARGIN = 0.03  # [m] skin that stays under the rim of a cloth
HEM_OVERLAP = 0.02  # [m]
TUCK, TUCK_MARGIN = 0.005, 0.006  # [m] that skin is drawn in, but for the last of it
CLOTH_REACH = 0.05  # [m] a cloth lies no further from the skin that it covers


SKIN_TRIANGLES = 13300
SHIRT_TRIANGLES = 2100  # before shoulders are rounded and hems are added; ours, for 30,000 in all
SHIRT_PRICE = 400.0  # of a vertex on shoulders, sleeves or the front; ours, so that the back is thinned in their place
TRUNK = ("hips", "spine", "chest", "upper_chest")
SHOULDER = 0.12  # [m] around a shoulder cloth is rounded, and less and less as far again
ARMPIT_STEPS = 4  # of smoothing, so that no cloth sticks out of the armpit of a raised arm
SLEEVE_OFF, SLEEVE_REACH = 0.008, 0.05  # [m] short sleeves stand off near their rim, so that a bent arm stays inside
EAR_FROM = 0.066  # [m] from the middle of the head
ARMS = ("left_upper_arm", "right_upper_arm")
HANDS = tuple(f"{side}_{part}" for side in ("left", "right") for part in ("hand", *rig.FINGERS))


def _quad_normals(points, quads):
    """(F, 3) unit."""
    across = np.cross(points[quads[:, 2]] - points[quads[:, 0]], points[quads[:, 3]] - points[quads[:, 1]])
    return across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)


def _islands(quads, count):
    """(F) which connected piece a quad belongs to."""
    a, b = quads.ravel(), np.roll(quads, 1, 1).ravel()
    _, label = connected_components(coo_matrix((np.ones(len(a)), (a, b)), shape=(count, count)), directed=False)
    return np.unique(label[quads[:, 0]], return_inverse=True)[1]


def _rim(quads):
    """The vertices at the open edges."""
    edges = np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
    unique, times = np.unique(edges[edges[:, 0] != edges[:, 1]], axis=0, return_counts=True)
    return np.unique(unique[times == 1])


class Maker:
    def __init__(self, package, person):
        self.package, self.person = package, person
        self.points = persons.shaped(package, person)
        self.weights = rig.softened(package, rig.base_weights(package))
        faces = face.FaceMoves(package, person)
        self.points += sum(share * faces.unit(unit) for unit, share in person.calm.items())
        self.moves = faces.all()
        base = package.base
        self.body = base.quads[base.groups == 0]
        self.body_uv = base.uv_quads[base.groups == 0]
        self.normals = surface.normals_of(self.points, self.body)
        self.normal_moves = {n: surface.normals_of(self.points + m, self.body) - self.normals for n, m in self.moves.items()}
        self.surfaces, self.materials, self.images = [], [], []
        self.hidden = np.zeros(len(self.points), bool)

    def material(
        self, name, roughness, colour=(1, 1, 1), image=None, alpha=None, double=False, anisotropy=0.0, specular=1.0,
        normals=None,
    ):
        pbr = {"metallicFactor": 0.0, "roughnessFactor": roughness}
        if image:
            self.images.append((name, *image))
            pbr["baseColorTexture"] = {"index": len(self.images) - 1}
        else:
            pbr["baseColorFactor"] = [round(float(c) ** 2.2, 4) for c in colour] + [1.0]
        entry = {"name": name, "pbrMetallicRoughness": pbr}
        if normals:
            self.images.append((f"{name} normals", *normals))
            entry["normalTexture"] = {"index": len(self.images) - 1}
        if alpha == "blend":
            entry["alphaMode"] = "BLEND"
        elif alpha:
            entry["alphaMode"] = "MASK"
            entry["alphaCutoff"] = alpha
        if double:
            entry["doubleSided"] = True
        extensions = {}
        if anisotropy:
            extensions["KHR_materials_anisotropy"] = {"anisotropyStrength": anisotropy}
        if specular != 1:
            extensions["KHR_materials_specular"] = {"specularFactor": specular}
        if extensions:
            entry["extensions"] = extensions
        self.materials.append(entry)

    def add_proxy(self, name, proxy, morphs=False, keep=None, wanted=None, shift=(0, 0, 0)):
        points = fitting.fitted(proxy, self.points) + shift
        quads, uv_quads = proxy.mesh.quads, proxy.mesh.uv_quads
        normals = surface.normals_of(points, quads)
        weights = fitting.carried_weights(proxy, self.weights)
        if name == "shirt":
            weights = rig.without(weights, ("head", "jaw"), "neck")
            arms = [rig.NAMES.index(joint) for joint in ARMS]
            near = surface.links(quads, len(points))
            below = points[:, 1:2] < self.joints[arms[0]][1]
            for _ in range(ARMPIT_STEPS):
                on_arm = below * weights[:, arms].sum(1)[:, None]
                weights = weights + 4 * on_arm * (1 - on_arm) * (near @ weights - weights)
            far = cKDTree(points[_rim(quads)]).query(points)[0]
            points = points + SLEEVE_OFF * (weights[:, arms].sum(1) * np.exp(-((far / SLEEVE_REACH) ** 2)))[:, None] * normals
        moves, turns = {}, {}
        if morphs:
            for morph, base_moves in self.moves.items():
                move = fitting.carried(proxy, base_moves)
                if np.linalg.norm(move, axis=1).max() > 10 * glb.LEAST_MOVE:
                    moves[morph] = move
                    turns[morph] = surface.normals_of(points + move, quads) - normals
        if keep is not None:
            quads, uv_quads = quads[keep], uv_quads[keep]
        part = surface.build(points, normals, quads, proxy.mesh.uvs, uv_quads, weights, moves, turns)
        if name == "shirt":
            near = cKDTree(self.joints[arms]).query(part.points)[0]
            trunk = part.weights[:, [rig.NAMES.index(joint) for joint in TRUNK]].sum(1)
            kept = np.maximum(np.clip(2 - near / SHOULDER, 0, 1), (trunk < 0.9) | (part.normals[:, 2] > 0))
            part = surface.thinned(part, SHIRT_TRIANGLES, 1 + SHIRT_PRICE * kept)
            near = cKDTree(self.joints[arms]).query(part.points)[0]
            part = hems.hemmed(surface.rounded(part, np.clip(2 - near / SHOULDER, 0, 1)))
            part.weights = rig.fewer(part.weights)
        self.surfaces.append((name, surface.thinned(part, wanted) if wanted else part))

    def add_eyes(self):
        balls = []
        for side, s in (("left", "L"), ("right", "R")):
            joint = rig.NAMES.index(f"{side}_eye")
            base = self.package.base
            helper = np.unique(base.quads[base.groups == base.group_names.index(f"helper-{s.lower()}-eye")])
            spread = self.points[helper]
            radius = (spread[:, 0].max() - spread[:, 0].min()) / 2
            balls.append((self.joints[joint], radius))
            self.surfaces.append(("eyes", eyes.eyeball(*balls[-1], joint, len(rig.NAMES))))
        self.material("eyes", 0.06, image=paint.jpeg(eyes.texture(512, self.person.colours["iris"], 7), 92))
        self.surfaces += lids.strips(self.points, surface.triangles_of(self.body), self.weights, self.moves, balls)
        self.material("eye_shadow", 1.0, alpha="blend", specular=0)
        self.material("eye_wet", 0.1, alpha="blend")

    def add_skin(self):
        seen = ~self.hidden[self.body].all(1)
        tucked = self.points - TUCK * self.tucked[:, None] * self.normals
        skin = surface.build(
            tucked, self.normals, self.body[seen], self.package.base.uvs, self.body_uv[seen], self.weights,
            self.moves, self.normal_moves,
        )
        # The face keeps its vertices, hands lose some, the rest of the head and the arms more.
        moved = sum(np.linalg.norm(move, axis=1) for move in skin.moves.values())
        hand = skin.weights[:, [i for i, name in enumerate(rig.NAMES) if name.startswith(HANDS)]].sum(1)
        ear = (np.abs(skin.points[:, 0]) > EAR_FROM) & (skin.points[:, 1] > self.head().eyes[1] - 0.08)
        price = np.where(moved > 0.0002, 400.0, np.where(hand > 0.5, 6.0, np.where(ear, 40.0, 1.0)))
        self.surfaces.append(("skin", surface.thinned(skin, SKIN_TRIANGLES, price)))
        mix = sum(share * self.package.image("skins", path)[..., :3] for path, share in self.person.skins.items())
        texture = paint.skin(mix, self.person)
        head = self.head()
        near = np.linalg.norm(self.points[self.body].mean(1) - head.eyes, axis=1) < 0.25
        face = surface.build(
            self.points, self.normals, self.body[near], self.package.base.uvs, self.body_uv[near], self.weights
        )
        places = np.concatenate([face.points, face.normals], 1)
        places = surface.in_texture(places, face.uvs, face.triangles, paint.SKIN_SIZE)
        texture = paint.mouth(texture, places[..., :3], np.array(self.person.colours["lips"]))
        style, colour = hair.STYLES[self.person.hair], self.person.colours["hair"]
        self.material("skin", 0.55, image=paint.jpeg(hair.painted_scalp(texture, head, style, colour, places, 31), 86))

    def head(self):
        joints = dict(zip(rig.NAMES, self.joints))
        return hair.Head(self.points, self.normals, self.body, joints)

    def add_hair(self):
        style, colour = hair.STYLES[self.person.hair], self.person.colours["hair"]
        part = hair.grown(style, self.head(), (self.body, self.points, self.normals), rig.NAMES.index("head"), len(rig.NAMES), 41)
        self.surfaces.append(("hair", part))
        texture = paint.png(hair.texture(colour, 43))
        self.material("hair", hair.ROUGHNESS, image=texture, alpha=0.4, double=True, anisotropy=hair.ANISOTROPY)

    def add_teeth(self):
        """Teeth and gums without texture: only what a mouth shows, and coarse."""
        proxy = self.package.proxy("teeth", "Teeth_Base")
        mesh = proxy.mesh
        piece = _islands(mesh.quads, len(mesh.points))  # the gums are one piece, each tooth is another
        depth = mesh.points[mesh.quads].mean(1)[:, 2]
        depth_of_piece = np.bincount(piece, depth) / np.bincount(piece)
        gums = piece == np.bincount(piece).argmax()
        points = fitting.fitted(proxy, self.points) - [0, 0, TEETH_BACK]
        lower = fitting.carried_weights(proxy, self.weights)[:, rig.NAMES.index("jaw")] > 0.5
        points[:, 1] += np.where(lower, LOWER_TEETH_UP, -UPPER_TEETH_DOWN)
        points[:, 2] -= np.where(lower, LOWER_TEETH_BACK, 0)
        foremost = points[mesh.quads[~gums], 2].max()
        whose = np.zeros(len(points), int)
        whose[mesh.quads] = piece[:, None]
        middles = np.stack([np.bincount(whose, points[:, k]) for k in range(3)], 1) / np.bincount(whose)[:, None]
        wide = points + TEETH_WIDER * (points - middles[whose]) * [1, 0, 1]
        for name, kept, colour, rough, wanted in (
            ("teeth", ~gums & (depth_of_piece[piece] > TEETH_FROM), (0.96, 0.94, 0.88), 0.25, 900),
            ("gums", gums & (depth > GUMS_FROM), (0.78, 0.46, 0.44), 0.4, 450),
        ):
            place = points - [0, 0, GUMS_BACK] if name == "gums" else wide
            price = np.where(place[:, 2] > foremost - TEETH_LIT - TEETH_FADE / 4, TEETH_LIT_PRICE, 1.0)
            part = self.add_plain(name, proxy, place, mesh.quads[kept], (wanted, price))
            behind = np.clip((foremost - TEETH_LIT - part.points[:, 2]) / TEETH_FADE, 0, 1)
            light = 1 - (1 - TEETH_DARK) * behind * behind * (3 - 2 * behind)
            part.colours = light[:, None] ** TEETH_REDDEN
            self.material(name, rough, colour, specular=TEETH_SPECULAR)

    def add_plain(self, name, proxy, points, quads, fewer):
        """Part of a proxy without texture coordinates, welded and decimated; `fewer` is how many triangles are wanted,
        and the price (V) of a vertex."""
        normals = surface.normals_of(points, proxy.mesh.quads)
        moves = {m: fitting.carried(proxy, base) for m, base in self.moves.items()}
        moves = {m: move for m, move in moves.items() if np.linalg.norm(move, axis=1).max() > 10 * glb.LEAST_MOVE}
        turns = {m: surface.normals_of(points + move, proxy.mesh.quads) - normals for m, move in moves.items()}
        weights = fitting.carried_weights(proxy, self.weights)
        part = surface.build(points, normals, quads, None, None, weights, moves, turns)
        used = np.unique(quads)  # without texture coordinates vertices keep their order
        wanted, price = fewer
        front = np.where(part.normals[:, 2] > TEETH_BACKWARD, TEETH_FRONT_PRICE, 1.0)
        part = surface.thinned(part, wanted, front * price[used])
        self.surfaces.append((name, part))
        return part

    def add_outfit(self, proxy):
        """Shirt and trousers of one proxy."""
        mesh = proxy.mesh
        piece = _islands(mesh.quads, len(mesh.points))
        height = mesh.points[mesh.quads].mean(1)[:, 1]
        top = np.array([height[piece == k].max() for k in range(piece.max() + 1)])
        upper = top[piece] > 0.2
        shadow = self.package.image("proxies", "clothes", proxy.folder.name, "textures", f"{proxy.folder.name}_ao.png")
        diffuse = self.package.image("proxies", "clothes", proxy.folder.name, "textures", f"{proxy.folder.name}_diffuse.png")
        shadow = paint.resized(shadow[..., :1], 1024)[..., 0]
        luma = paint.resized((diffuse[..., :3] @ paint.LUMA)[..., None], 1024)[..., 0]
        points = fitting.fitted(proxy, self.points)
        shirt = surface.build(
            points, surface.normals_of(points, mesh.quads), mesh.quads[upper], mesh.uvs, mesh.uv_quads[upper],
            fitting.carried_weights(proxy, self.weights),
        )
        openness, bumps = folds.drape(shirt, dict(zip(rig.NAMES, self.joints)), 1024)
        for name, kept, weave, seed in (("shirt", upper, False, 21), ("trousers", ~upper, True, 22)):
            light = openness if name == "shirt" else np.clip(luma / np.median(luma), 0.7, 1.3) ** 0.5
            self.add_proxy(name, proxy, keep=kept, wanted=None if name == "shirt" else 700)
            texture = paint.cloth(shadow, light, self.person.colours[name], weave, seed)
            normals = paint.jpeg(bumps, 90, full_colour=True) if name == "shirt" else None
            self.material(name, 0.88, image=paint.jpeg(texture, 82), double=True, normals=normals)

    def covered(self, proxy, margin):
        """(V) whether a vertex of the skin lies under a cloth, further than `margin` [m] inside its rim."""
        cloth = fitting.fitted(proxy, self.points)
        quads = proxy.mesh.quads
        middles = cloth[quads].mean(1)
        near, which = cKDTree(middles).query(self.points)
        inside = cKDTree(cloth[_rim(quads)]).query(self.points)[0] > margin
        deep = ((self.points - middles[which]) * _quad_normals(cloth, quads)[which]).sum(1) < 0.002
        return (near < CLOTH_REACH) & inside & deep

    def clothing(self):
        outfit = self.package.proxy("clothes", self.person.outfit)
        shoes = self.package.proxy("clothes", self.person.shoes)
        for proxy in (outfit, shoes):
            self.hidden[proxy.hides] = True
            self.hidden |= self.covered(proxy, RIM_MARGIN)
        self.tucked = self.covered(outfit, TUCK_MARGIN)
        return outfit, shoes


def make(package, person, path):
    maker = Maker(package, person)
    outfit, shoes = maker.clothing()
    soles = fitting.fitted(shoes, maker.points)[:, 1].min()
    maker.points[:, 1] -= soles
    maker.joints = rig.joint_points(package, maker.points)
    maker.add_skin()
    maker.add_eyes()
    colours = person.colours
    maker.add_outfit(outfit)
    # The shafts of the shoes end under the hems of the trousers.
    hem = fitting.fitted(outfit, maker.points)[:, 1].min()
    low = fitting.fitted(shoes, maker.points)[shoes.mesh.quads].mean(1)[:, 1] < hem + HEM_OVERLAP
    maker.add_proxy("shoes", shoes, keep=low, wanted=950)
    maker.material("shoes", 0.6, colours["shoes"], double=True)
    maker.add_hair()
    for name, kind, proxy in (("brows", "eyebrows", person.brows), ("lashes", "eyelashes", person.lashes)):
        item = package.proxy(kind, proxy)
        maker.add_proxy(name, item, morphs=True)
        picture = sorted((item.folder / "textures").glob("*.png"))[0]
        rgba = np.asarray(Image.open(picture)).astype(float) / 255
        colour = (0.06, 0.05, 0.05) if name == "lashes" else np.array(colours["hair"]) * 0.9
        rgba = paint.recoloured(rgba, colour, contrast=0.0)
        maker.material(name, 0.7, image=paint.png(rgba), alpha="blend", double=True)
    maker.add_teeth()
    maker.add_proxy("tongue", package.proxy("tongue", "tongue01"), True, shift=TONGUE_SHIFT)
    tongue = package.image("proxies", "tongue", "tongue01", "textures", "tongue01_diffuse.png")
    image = paint.jpeg(TONGUE_TINT * tongue[::2, ::2, :3])
    maker.material("tongue", 0.6, image=image, specular=TONGUE_SPECULAR)
    glb.write_glb(path, person.name, maker.surfaces, maker.materials, maker.images, (rig.NAMES, rig.PARENTS, maker.joints), rig.strongest_four)
    count = {}
    for name, part in maker.surfaces:
        count[name] = count.get(name, 0) + len(part.triangles)
    return f"{path}: {sum(count.values())} triangles {count}, {path.stat().st_size} bytes"
