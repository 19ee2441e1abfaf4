# Run with Debian's python3-torch: python3 tests/synth/learned/styles/reference.py > tests/synth/learned/styles/reference.json
"""A second implementation of the networks that transfer a style of gesture: ZS-MSTM 1.0 and 2.0 (Fares 2023), the published
Mix-StAGE (Ahuja et al. 2020) and the classifier that judges styles. The tests compare the C++ networks with what this prints.

No weights are stored. Every parameter, buffer and input is filled by a formula from its name (see `formula`), in float32; the
networks are then evaluated in float64 without dropout, and BatchNorm uses its running values, except where Mix-StAGE learns,
which uses those of the batch. B segments, T frames.
"""

import json
import math
import re
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Optional

import torch
import torch.nn.functional as F
from torch import nn
from torch.overrides import TorchFunctionMode

BATCH = 2
MEL = 128          # mel bands of ZS-MSTM
WORD = 768         # width of a word vector of BERT
POSE = 22          # 11 joints, x and y
FACE = 30          # 15 points, x and y
TAGS = 38          # dialog tags, 0 or 1
STAGE_FRAMES = 64  # Mix-StAGE: frames of a segment
STAGE_MEL = 64     # Mix-StAGE: mel bands


# ---- Values by name ---------------------------------------------------------------------------------------------------------


def formula(name, shape):
    """sin(0.37 i + h), i the row-major index and h the sum of the bytes of the name."""
    h = float(sum(name.encode()))
    i = torch.arange(math.prod(shape), dtype=torch.float64)
    return torch.sin(0.37 * i + h).reshape(shape)


def rounded(values):
    """The values as float32 holds them, in float64."""
    return values.float().double()


def fill(module):
    """Gives every parameter and buffer of the network the value of its dotted name."""
    with torch.no_grad():
        for name, tensor in module.state_dict().items():
            if name.endswith("num_batches_tracked"):
                continue
            values = 0.1 * formula(name, tensor.shape)
            if name.endswith("running_var") or re.search(r"norm[123]?\.weight$", name):
                values = 1 + values
            tensor.copy_(rounded(values))
    return module.double().eval()


def example(name, *shape):
    """An input or a target."""
    return rounded(formula(name, shape))


def example_tags():
    return (formula("tags", (BATCH, TAGS)) > 0).double()


# ---- ZS-MSTM ----------------------------------------------------------------------------------------------------------------


@dataclass
class ZsSizes:
    frames: int                   # frames of a segment
    ast: int                      # width of the audio spectrogram transformer (AST)
    ast_heads: int
    ast_depth: int
    ast_ffn: int
    d: int                        # width of the decoders
    ffn: int
    lstm: int
    hidden: int                   # of the discriminator
    text: Optional[int] = None    # words are projected to this width; None: they keep their 768 values
    speech: Optional[int] = None  # the outputs of AST are projected to this width; None: they are not projected
    attention_heads: int = 4
    decoder_heads: int = 2
    face: bool = False            # version 2.0: face and dialog tags as well
    shared_ast: bool = False      # content and style use one AST

    @property
    def content(self):
        return (self.text or WORD) + (self.speech or self.ast)

    @property
    def style(self):
        return self.content + self.lstm + (self.lstm + TAGS if self.face else 0)


class Ast(nn.Module):
    """Audio spectrogram transformer (Gong et al. 2021) with the names of its published weights. (B, T, MEL) to (B, ast)."""

    def __init__(self, frames, d, heads, depth, ffn):
        super().__init__()
        patches = ((MEL - 16) // 10 + 1) * ((frames - 16) // 10 + 1)
        self.cls_token = nn.Parameter(torch.zeros(1, 1, d))
        self.dist_token = nn.Parameter(torch.zeros(1, 1, d))
        self.pos_embed = nn.Parameter(torch.zeros(1, 2 + patches, d))
        self.patch_embed = nn.Module()
        self.patch_embed.proj = nn.Conv2d(1, d, kernel_size=16, stride=10)
        self.blocks = nn.ModuleList(AstBlock(d, heads, ffn) for _ in range(depth))
        self.norm = nn.LayerNorm(d, eps=1e-6)

    def forward(self, mel):
        image = mel.transpose(1, 2).unsqueeze(1)                               # (B, 1, MEL, T)
        patches = self.patch_embed.proj(image).flatten(2).transpose(1, 2)      # (B, patches, d), time changes fastest
        first = [token.expand(len(mel), -1, -1) for token in (self.cls_token, self.dist_token)]
        tokens = torch.cat(first + [patches], dim=1) + self.pos_embed
        for block in self.blocks:
            tokens = block(tokens)
        return self.norm(tokens)[:, 0]


class AstBlock(nn.Module):
    """A transformer layer that normalises first, as in timm."""

    def __init__(self, d, heads, ffn):
        super().__init__()
        self.heads = heads
        self.norm1 = nn.LayerNorm(d, eps=1e-6)
        self.attn = nn.Module()
        self.attn.qkv = nn.Linear(d, 3 * d)
        self.attn.proj = nn.Linear(d, d)
        self.norm2 = nn.LayerNorm(d, eps=1e-6)
        self.mlp = nn.Module()
        self.mlp.fc1 = nn.Linear(d, ffn)
        self.mlp.fc2 = nn.Linear(ffn, d)

    def forward(self, x):
        x = x + self.attend(self.norm1(x))
        return x + self.mlp.fc2(F.gelu(self.mlp.fc1(self.norm2(x))))

    def attend(self, x):
        b, n, d = x.shape
        q, k, v = self.attn.qkv(x).reshape(b, n, 3, self.heads, d // self.heads).permute(2, 0, 3, 1, 4)  # (B, heads, n, -1)
        weights = (q @ k.transpose(-1, -2) / math.sqrt(d // self.heads)).softmax(dim=-1)
        return self.attn.proj((weights @ v).transpose(1, 2).reshape(b, n, d))


@dataclass
class Segment:
    mel: torch.Tensor                    # (B, T, MEL)
    text: torch.Tensor                   # (B, T, WORD)
    pose: torch.Tensor                   # (B, T, POSE)
    face: Optional[torch.Tensor] = None  # (B, T, FACE)
    tags: Optional[torch.Tensor] = None  # (B, TAGS)


class ZsMstm(nn.Module):
    """The generator of ZS-MSTM 1.0, and of 2.0 if sizes.face."""

    def __init__(self, sizes):
        super().__init__()
        self.sizes = s = sizes
        for part in ("content", "style"):
            if part == "content" or not s.shared_ast:
                setattr(self, part + "_ast", Ast(s.frames, s.ast, s.ast_heads, s.ast_depth, s.ast_ffn))
            if s.speech:
                setattr(self, part + "_projection", nn.Linear(s.ast, s.speech))
            if s.text:
                setattr(self, part + "_text", nn.Linear(WORD, s.text))
            setattr(self, part + "_attention", nn.MultiheadAttention(s.content, s.attention_heads, batch_first=True))
        self.pose_lstm = nn.LSTM(POSE, s.lstm, num_layers=3, batch_first=True)
        if s.face:
            self.face_lstm = nn.LSTM(FACE, s.lstm, num_layers=3, batch_first=True)
        for output, width in {"pose": POSE, "face": FACE}.items():
            if output == "pose" or s.face:
                setattr(self, output + "_in", nn.Linear(s.content + s.style, s.d))
                setattr(self, output + "_decoder", nn.TransformerDecoderLayer(s.d, s.decoder_heads, s.ffn, batch_first=True))
                setattr(self, output + "_out", nn.Linear(s.d, width))

    def forward(self, segment):
        content, style = self.content(segment), self.style(segment)
        face = self.decode("face", content, style) if self.sizes.face else None
        return content, style, self.decode("pose", content, style), face

    def content(self, segment):
        """(B, T, content)"""
        return self.attend("content", segment)

    def style(self, segment):
        """(B, style)"""
        parts = [self.attend("style", segment).mean(dim=1), last_state(self.pose_lstm, segment.pose)]
        if self.sizes.face:
            parts += [last_state(self.face_lstm, segment.face), segment.tags]
        return torch.cat(parts, dim=-1)

    def attend(self, part, segment):
        """Self-attention over each frame's words and the speech of the whole segment. (B, T, content)"""
        speech = (self.content_ast if self.sizes.shared_ast else getattr(self, part + "_ast"))(segment.mel)
        if self.sizes.speech:
            speech = getattr(self, part + "_projection")(speech)
        text = getattr(self, part + "_text")(segment.text) if self.sizes.text else segment.text
        both = torch.cat([text, repeat(speech, text.shape[1])], dim=-1)
        return getattr(self, part + "_attention")(both, both, both, need_weights=False)[0]

    def decode(self, output, content, style):
        """One decoder layer that is its own memory; no frame sees a later one. (B, T, POSE or FACE)"""
        frames = content.shape[1]
        x = getattr(self, output + "_in")(torch.cat([content, repeat(style, frames)], dim=-1))
        x = x + positions(frames, x.shape[-1])
        later = torch.ones(frames, frames, dtype=torch.bool).triu(diagonal=1)
        decoded = getattr(self, output + "_decoder")(x, x, tgt_mask=later, memory_mask=later)
        return getattr(self, output + "_out")(decoded)


class Discriminator(nn.Module):
    """The fader's adversary: predicts the style (B, style) from the content (B, T, content)."""

    def __init__(self, sizes):
        super().__init__()
        self.first = nn.Linear(sizes.content, sizes.hidden)
        self.dropout = nn.Dropout(0.3)
        self.second = nn.Linear(sizes.hidden, sizes.hidden)
        self.last = nn.Linear(sizes.hidden, sizes.style)

    def forward(self, content):
        x = self.dropout(F.leaky_relu(self.first(content.mean(dim=1)), 0.2))
        return self.last(F.leaky_relu(self.second(x), 0.2))


def repeat(vector, frames):
    return vector.unsqueeze(1).expand(-1, frames, -1)


def last_state(lstm, sequence):
    """The last hidden state of the top layer."""
    return lstm(sequence)[1][0][-1]


def positions(frames, d):
    """Sinusoidal positions: sines in the even columns and cosines in the odd ones. (T, d)"""
    angle = torch.arange(frames).double()[:, None] / 10000 ** (torch.arange(0, d, 2).double() / d)
    return torch.stack([angle.sin(), angle.cos()], dim=-1).reshape(frames, d)


def adversarial_loss(style, predicted):
    error = (style.detach().sigmoid() - predicted.sigmoid()).abs()
    return ((1 - error) ** 2).mean()


# ---- Mix-StAGE --------------------------------------------------------------------------------------------------------------
# The printed counts (15,144,520 and 15,325,080; discriminator 171,713 and 190,657) are met exactly, and they settle this:
# every convolution has a bias, the one before a BatchNorm too; the last block of the style encoder is a whole block, so that
# the logits have passed BatchNorm and LeakyReLU; `classify_out` and `decoder_out` have kernel 1; each of the K groups of
# `decoder` takes 266 channels, of which 256 are content and 10 style, and gives 256, so that `decoder` holds K x 256 channels.
# The counts say nothing about padding; ours is (kernel - stride) / 2 rounded down, as in the authors' code, but 0 in the
# discriminator's last layer. 64 frames become 32, 16, 15 and 12 in the discriminator.


@dataclass
class StageSizes:
    pose: int
    speakers: int = 16
    clusters: int = 8
    divisor: int = 1  # all widths but that of the style are divided by it
    style: int = 10


class Block(nn.Module):
    """Convolution, BatchNorm, LeakyReLU. `inputs` and `outputs` are the channels of one group."""

    def __init__(self, inputs, outputs, kernel=3, stride=1, groups=1, dimensions=1):
        super().__init__()
        convolution, norm = {1: (nn.Conv1d, nn.BatchNorm1d), 2: (nn.Conv2d, nn.BatchNorm2d)}[dimensions]
        kernel = kernel if isinstance(kernel, tuple) else (kernel,) * dimensions
        padding = tuple((k - stride) // 2 for k in kernel)
        self.conv = convolution(inputs * groups, outputs * groups, kernel, stride, padding, groups=groups)
        self.norm = norm(outputs * groups)

    def forward(self, x):
        return F.leaky_relu(self.norm(self.conv(x)), 0.2)


def down(inputs, outputs, dimensions=1):
    return Block(inputs, outputs, kernel=4, stride=2, dimensions=dimensions)


class UNet(nn.Module):
    """(B, width, T) to the same shape."""

    def __init__(self, width):
        super().__init__()
        self.first = nn.Sequential(*[Block(width, width) for _ in range(2)])
        self.down = nn.ModuleList(down(width, width) for _ in range(5))
        self.up = nn.ModuleList(Block(width, width) for _ in range(5))

    def forward(self, x):
        scales = [self.first(x)]  # 64, 32, 16, 8, 4 and 2 frames
        for block in self.down:
            scales.append(block(scales[-1]))
        x = scales.pop()
        for block in self.up:
            x = block(F.interpolate(x, scale_factor=2, mode="nearest") + scales.pop())
        return x


class MixStage(nn.Module):
    """The generator of Mix-StAGE."""

    def __init__(self, sizes):
        super().__init__()
        self.sizes = sizes
        a, b, c = (width // sizes.divisor for width in (64, 128, 256))
        mixed = c + sizes.style
        self.audio_encoder = nn.Sequential(
            Block(1, a, dimensions=2), down(a, a, 2), Block(a, b, dimensions=2), down(b, b, 2), Block(b, c, dimensions=2),
            down(c, c, 2), Block(c, c, dimensions=2), Block(c, c, kernel=(3, 8), dimensions=2))
        self.pose_encoder = nn.Sequential(
            Block(sizes.pose, a), Block(a, a), Block(a, b), Block(b, b), Block(b, c), Block(c, c))
        self.unet = UNet(c)
        self.style_encoder = nn.Sequential(
            Block(sizes.pose, a), down(a, a), down(a, b), down(b, b), down(b, c), down(c, c), down(c, sizes.speakers))
        self.styles = nn.Embedding(sizes.speakers, sizes.style)
        self.classify = nn.Sequential(Block(mixed, c), *[Block(c, c) for _ in range(5)])
        self.classify_out = nn.Conv1d(c, sizes.clusters, kernel_size=1)
        self.decoder = nn.Sequential(
            Block(mixed, c, groups=sizes.clusters), *[Block(c, c, groups=sizes.clusters) for _ in range(3)])
        self.decoder_out = nn.Conv1d(c * sizes.clusters, sizes.pose * sizes.clusters, kernel_size=1, groups=sizes.clusters)

    def style_logits(self, pose):
        """(B, T, pose) to (B, speakers)"""
        return self.style_encoder(pose.transpose(1, 2)).mean(dim=-1)

    def content_of_audio(self, mel):
        """(B, T, STAGE_MEL) to (B, 256, T): time is the height of the image, and one column is left of its width."""
        image = self.audio_encoder(mel.unsqueeze(1))
        return F.interpolate(image, size=(mel.shape[1], 1), mode="bilinear", align_corners=False).squeeze(-1)

    def content_of_pose(self, pose):
        return self.pose_encoder(pose.transpose(1, 2))

    def forward(self, content, style_id):
        """Pose (B, T, pose) and the logits of the clusters (B, T, K), of encoded audio or pose (B, 256, T) and ids (B)."""
        content = self.unet(content)
        style = self.styles(style_id).unsqueeze(-1).expand(-1, -1, content.shape[-1])
        mixed = torch.cat([content, style], dim=1)                                # (B, 266, T)
        clusters = self.classify_out(self.classify(mixed)).transpose(1, 2)
        poses = self.decoder_out(self.decoder(mixed.repeat(1, self.sizes.clusters, 1)))
        poses = poses.reshape(len(poses), self.sizes.clusters, self.sizes.pose, -1)  # (B, K, pose, T)
        return torch.einsum("btk,bkpt->btp", clusters.softmax(dim=-1), poses), clusters


class StageDiscriminator(nn.Module):
    """Scores (B, 12) of the velocities of poses (B, 64, pose): 1 is real, 0 is generated."""

    def __init__(self, sizes):
        super().__init__()
        a, b, c = (width // sizes.divisor for width in (64, 128, 256))
        self.first = nn.Conv1d(sizes.pose, a, kernel_size=4, stride=2, padding=1)
        self.second = down(a, b)
        self.third = Block(b, c, kernel=4)
        self.last = nn.Conv1d(c, 1, kernel_size=4)

    def forward(self, pose):
        velocity = torch.cat([torch.zeros_like(pose[:, :1]), pose[:, 1:] - pose[:, :-1]], dim=1)
        x = F.leaky_relu(self.first(velocity.transpose(1, 2)), 0.2)
        return self.last(self.third(self.second(x))).squeeze(1)


# ---- Classifier of styles ---------------------------------------------------------------------------------------------------


class Classifier(nn.Module):
    """Whether gestures (B, T, width) have the second of two styles: logits (B)."""

    def __init__(self, width, lstm):
        super().__init__()
        self.lstm = nn.LSTM(width, lstm, num_layers=3, dropout=0.5, batch_first=True)
        self.dropout = nn.Dropout(0.5)
        self.out = nn.Linear(lstm, 1)

    def forward(self, gestures):
        return self.out(self.dropout(last_state(self.lstm, gestures))).squeeze(-1)


# ---- Presets and their numbers of parameters --------------------------------------------------------------------------------

AST_BASE = dict(ast=768, ast_heads=12, ast_depth=12, ast_ffn=3072)
AST_SMALL = dict(ast=64, ast_heads=4, ast_depth=4, ast_ffn=256)
AST_TINY = dict(ast=8, ast_heads=2, ast_depth=2, ast_ffn=16)

ZS1_PAPER = ZsSizes(frames=64, **AST_BASE, d=768, ffn=2048, lstm=768, hidden=512)
ZS1_SMALL = ZsSizes(frames=64, **AST_SMALL, d=64, ffn=256, lstm=64, hidden=128, text=64)
ZS1_TINY = ZsSizes(frames=64, **AST_TINY, d=8, ffn=16, lstm=8, hidden=12, text=8)
ZS2_PAPER = ZsSizes(frames=16, **{**AST_SMALL, "ast_depth": 12}, d=64, ffn=2048, lstm=64, hidden=256, face=True)
ZS2_PRETRAINED = replace(ZS2_PAPER, **AST_BASE, speech=64)
ZS2_SMALL = replace(ZS1_SMALL, frames=16, face=True)
ZS2_TINY = replace(ZS1_TINY, frames=16, face=True)
ZS2_PROJECTED = replace(ZS2_TINY, text=None, speech=4)

STAGE = StageSizes(pose=22)
STAGE_SMALL = StageSizes(pose=22, clusters=4, divisor=4)
STAGE_TINY = StageSizes(pose=22, speakers=3, clusters=4, divisor=16)


class OnMeta(TorchFunctionMode):
    """Modules made under this have shapes but no memory."""

    def __torch_function__(self, function, types, args=(), kwargs=None):
        kwargs = dict(kwargs or {})
        if function in (torch.empty, torch.zeros, torch.ones):
            kwargs["device"] = "meta"
        return function(*args, **kwargs)


def count(kind, *arguments, part=""):
    """Parameters of a network, or of all its members whose name contains `part`."""
    with OnMeta():
        module = kind(*arguments)
    return sum(parameter.numel() for name, parameter in module.named_parameters() if part in name.split(".")[0])


def compared(number, printed=None):
    return {"count": number} if printed is None else {"count": number, "printed": printed, "agrees": number == printed}


def counts():
    """Each number beside that of the specification (`printed`), where it gives one. Mix-StAGE: 16 speakers."""
    base = tuple(AST_BASE.values())
    small = tuple(AST_SMALL.values())
    shared = replace(ZS1_PAPER, shared_ast=True)
    outside_ast = lambda sizes: count(ZsMstm, sizes) - count(ZsMstm, sizes, part="_ast")
    return {
        "ast_base_64_frames": compared(count(Ast, 64, *base), 85_302_528),
        "ast_base_16_frames": compared(count(Ast, 16, *base), 85_265_664),
        "ast_base_1024_frames": compared(count(Ast, 1024, *base), 86_187_264),
        "ast_small_64_frames": compared(count(Ast, 64, *small)),
        "ast_small_16_frames": compared(count(Ast, 16, *small)),
        "zs1_paper": compared(count(ZsMstm, ZS1_PAPER), 212_218_902),
        "zs1_shared": compared(count(ZsMstm, shared), 126_916_374),
        "zs1_shared_ast": compared(count(ZsMstm, shared, part="_ast"), 85_302_528),
        "zs1_shared_discriminator": compared(count(Discriminator, shared), 2_231_552),
        "zs1_paper_without_ast": compared(outside_ast(ZS1_PAPER), 41_613_846),
        "zs1_paper_ast": compared(count(ZsMstm, ZS1_PAPER, part="_ast"), 170_605_056),
        "zs1_paper_attention": compared(count(ZsMstm, ZS1_PAPER, part="_attention"), 18_886_656),
        "zs1_paper_pose_lstm": compared(count(ZsMstm, ZS1_PAPER, part="pose_lstm"), 11_882_496),
        "zs1_paper_pose_in": compared(count(ZsMstm, ZS1_PAPER, part="pose_in"), 2_949_888),
        "zs1_paper_pose_decoder": compared(count(ZsMstm, ZS1_PAPER, part="pose_decoder"), 7_877_888),
        "zs1_paper_pose_out": compared(count(ZsMstm, ZS1_PAPER, part="pose_out"), 16_918),
        "zs1_paper_discriminator": compared(count(Discriminator, ZS1_PAPER), 2_231_552),
        "zs1_small": compared(count(ZsMstm, ZS1_SMALL), 849_558),
        "zs1_small_ast": compared(count(ZsMstm, ZS1_SMALL, part="_ast"), 441_216),
        "zs1_small_discriminator": compared(count(Discriminator, ZS1_SMALL), 57_792),
        "zs2_paper": compared(count(ZsMstm, ZS2_PAPER), 7_793_076),
        "zs2_paper_without_ast": compared(outside_ast(ZS2_PAPER), 6_558_260),
        "zs2_paper_ast": compared(count(ZsMstm, ZS2_PAPER, part="_ast"), 2 * 617_408),
        "zs2_paper_attention": compared(count(ZsMstm, ZS2_PAPER, part="_attention"), 2 * 2_772_224),
        "zs2_paper_lstm": compared(count(ZsMstm, ZS2_PAPER, part="_lstm"), 89_088 + 91_136),
        "zs2_paper_in": compared(count(ZsMstm, ZS2_PAPER, part="_in"), 2 * 117_184),
        "zs2_paper_decoder": compared(count(ZsMstm, ZS2_PAPER, part="_decoder"), 2 * 297_920),
        "zs2_paper_out": compared(count(ZsMstm, ZS2_PAPER, part="_out"), 1_430 + 1_950),
        "zs2_paper_discriminator": compared(count(Discriminator, ZS2_PAPER), 535_526),
        "zs2_pretrained": compared(count(ZsMstm, ZS2_PRETRAINED), 177_188_020),
        "zs2_pretrained_ast": compared(count(ZsMstm, ZS2_PRETRAINED, part="_ast"), 2 * 85_265_664),
        "zs2_pretrained_discriminator": compared(count(Discriminator, ZS2_PRETRAINED), 535_526),
        "zs2_small": compared(count(ZsMstm, ZS2_SMALL)),
        "zs2_small_ast": compared(count(ZsMstm, ZS2_SMALL, part="_ast")),
        "zs2_small_discriminator": compared(count(Discriminator, ZS2_SMALL)),
        "mix_stage_paper": compared(count(MixStage, STAGE), 15_144_520),
        "mix_stage_joints": compared(count(MixStage, replace(STAGE, pose=96)), 15_325_080),
        "mix_stage_paper_discriminator": compared(count(StageDiscriminator, STAGE), 171_713),
        "mix_stage_joints_discriminator": compared(count(StageDiscriminator, replace(STAGE, pose=96)), 190_657),
        "mix_stage_small": compared(count(MixStage, STAGE_SMALL)),
        "mix_stage_small_discriminator": compared(count(StageDiscriminator, STAGE_SMALL)),
        "classifier_paper": compared(count(Classifier, POSE, 800), 12_890_401),
        "classifier_pose_and_face": compared(count(Classifier, POSE + FACE, 800)),
        "classifier_small": compared(count(Classifier, POSE, 64), 89_153),
    }


# ---- Outputs and training steps of tiny networks ----------------------------------------------------------------------------


def summary(tensor, edge):
    """The first and last `edge` values in row-major order, and sums over all."""
    flat = tensor.flatten()
    return {"shape": list(tensor.shape), "first": flat[:edge].tolist(), "last": flat[-edge:].tolist(),
            "sum": flat.sum().item(), "sum_of_squares": (flat ** 2).sum().item()}


def sums(tensors):
    """name: [sum, sum of squares]"""
    return {name: [tensor.sum().item(), (tensor ** 2).sum().item()] for name, tensor in tensors}


def gradients(module, loss):
    """Sums of the gradients of all parameters that the loss depends on."""
    module.zero_grad()
    loss.backward()
    return sums((name, p.grad) for name, p in module.named_parameters() if p.grad is not None)


@contextmanager
def frozen(module):
    """Losses that are computed under this give the module's parameters no gradient."""
    module.requires_grad_(False)
    yield
    module.requires_grad_(True)


def zs_segment(sizes):
    t = sizes.frames
    segment = Segment(mel=example("mel", BATCH, t, MEL), text=example("text", BATCH, t, WORD),
                      pose=example("pose", BATCH, t, POSE))
    if sizes.face:
        segment.face, segment.tags = example("face", BATCH, t, FACE), example_tags()
    return segment


def zs_losses(generator, discriminator, segment):
    content, style, pose, face = generator(segment)
    reconstruction = F.mse_loss(pose, example("target", *pose.shape))
    if face is not None:
        reconstruction = reconstruction + F.mse_loss(face, example("target_face", *face.shape))
    return {"reconstruction": reconstruction,
            "adversarial": adversarial_loss(style, discriminator(content)),
            "discriminator": F.mse_loss(discriminator(content.detach()), style.detach())}


def zs_outputs(sizes):
    generator, discriminator = fill(ZsMstm(sizes)), fill(Discriminator(sizes))
    segment = zs_segment(sizes)
    content, style, pose, face = generator(segment)
    result = {"sizes": vars(sizes), "h_content": summary(content, 4), "h_style": style.tolist(), "pose": summary(pose, POSE)}
    if face is not None:
        result["face"] = summary(face, FACE)
    result["discriminator"] = discriminator(content).tolist()
    result["losses"] = {name: loss.item() for name, loss in zs_losses(generator, discriminator, segment).items()}
    return result


def zs_step(sizes):
    """First the discriminator learns, then the generator against the discriminator that has learned."""
    generator, discriminator = fill(ZsMstm(sizes)), fill(Discriminator(sizes))
    segment = zs_segment(sizes)
    discriminator_loss = zs_losses(generator, discriminator, segment)["discriminator"]
    of_discriminator = gradients(discriminator, discriminator_loss)
    torch.optim.Adam(discriminator.parameters(), lr=1e-3, betas=(0.95, 0.999), eps=1e-8).step()
    with frozen(discriminator):
        losses = zs_losses(generator, discriminator, segment)
        total = losses["reconstruction"] + 0.5 * losses["adversarial"]
    return {"losses": {"discriminator": discriminator_loss.item(), "adversarial": losses["adversarial"].item(),
                       "generator": total.item()},
            "generator": gradients(generator, total), "discriminator": of_discriminator}


@dataclass
class StageBatch:
    mel: torch.Tensor       # (B, T, STAGE_MEL)
    pose: torch.Tensor      # (B, T, pose)
    speakers: torch.Tensor  # (B) ids
    clusters: torch.Tensor  # (B, T) labels


def stage_batch(sizes):
    return StageBatch(mel=example("mel", BATCH, STAGE_FRAMES, STAGE_MEL), pose=example("pose", BATCH, STAGE_FRAMES, sizes.pose),
                      speakers=torch.arange(BATCH), clusters=(torch.arange(STAGE_FRAMES) % sizes.clusters).repeat(BATCH, 1))


def stage_discriminator_loss(discriminator, real, generated):
    real, generated = discriminator(real), discriminator(generated.detach())
    return F.l1_loss(real, torch.ones_like(real)) + F.l1_loss(generated, torch.zeros_like(generated))


def stage_losses(generator, discriminator, batch):
    """The terms of the losses. The generator gets the style id that the style encoder finds in the real pose. The target of
    `id_out` is the true speaker, as in the authors' code. `id_out_style` has the style id as its target; nothing learns from it."""
    logits = generator.style_logits(batch.pose)
    style_id = logits.argmax(dim=-1)
    pose, clusters = generator(generator.content_of_audio(batch.mel), style_id)
    score = discriminator(pose)
    with frozen(generator.style_encoder):
        generated_logits = generator.style_logits(pose)
    losses = {"pose": F.l1_loss(pose, batch.pose), "gan": F.l1_loss(score, torch.ones_like(score)),
              "cluster": F.cross_entropy(clusters.transpose(1, 2), batch.clusters),
              "id_in": F.cross_entropy(logits, batch.speakers), "id_out": F.cross_entropy(generated_logits, batch.speakers),
              "id_out_style": F.cross_entropy(generated_logits, style_id)}
    losses["generator"] = losses["pose"] + losses["gan"] + losses["cluster"] + 0.1 * losses["id_in"] + 0.1 * losses["id_out"]
    return losses


def stage_outputs(sizes):
    generator, discriminator = fill(MixStage(sizes)), fill(StageDiscriminator(sizes))
    batch = stage_batch(sizes)
    logits = generator.style_logits(batch.pose)
    style_id = logits.argmax(dim=-1)
    content = generator.content_of_audio(batch.mel)
    pose, clusters = generator(content, style_id)
    from_pose, _ = generator(generator.content_of_pose(batch.pose), style_id)
    losses = stage_losses(generator, discriminator, batch)
    losses["discriminator"] = stage_discriminator_loss(discriminator, batch.pose, pose)
    return {"sizes": vars(sizes), "style_logits": logits.tolist(), "style_id": style_id.tolist(),
            "content_of_audio": summary(content, 4), "pose": summary(pose, sizes.pose),
            "cluster_weights": summary(clusters.softmax(dim=-1), 2 * sizes.clusters),
            "pose_with_content_of_pose": summary(from_pose, sizes.pose),
            "discriminator_of_real": discriminator(batch.pose).tolist(),
            "discriminator_of_generated": discriminator(pose).tolist(),
            "losses": {name: loss.item() for name, loss in losses.items()}}


def stage_step(sizes):
    """As zs_step. Who learns normalises by the batch, and so does the discriminator that the generator learns against."""
    generator, discriminator = fill(MixStage(sizes)), fill(StageDiscriminator(sizes))
    batch = stage_batch(sizes)
    pose, _ = generator(generator.content_of_audio(batch.mel), generator.style_logits(batch.pose).argmax(dim=-1))
    discriminator_loss = stage_discriminator_loss(discriminator.train(), batch.pose, pose)
    of_discriminator = gradients(discriminator, discriminator_loss)
    torch.optim.Adam(discriminator.parameters(), lr=1e-4).step()
    with frozen(discriminator):
        losses = stage_losses(generator.train(), discriminator, batch)
    of_generator = gradients(generator, losses["generator"])
    return {"losses": {"discriminator": discriminator_loss.item(), "gan": losses["gan"].item(),
                       "generator": losses["generator"].item()},
            "generator": of_generator, "discriminator": of_discriminator,
            "running": sums((name, b) for name, b in generator.named_buffers() if "running" in name)}


def classifier_outputs():
    classifier = fill(Classifier(POSE, 8))
    logits = classifier(example("pose", BATCH, 64, POSE))
    loss = F.binary_cross_entropy_with_logits(logits, torch.arange(BATCH).double())
    return {"sizes": {"width": POSE, "lstm": 8, "frames": 64},
            "logits": logits.tolist(), "probability": logits.sigmoid().tolist(),
            "loss": loss.item(), "gradients": gradients(classifier, loss)}


# ---- Output -----------------------------------------------------------------------------------------------------------------


def digits(value):
    """The same tree with 9 significant digits in every number that is no integer."""
    if isinstance(value, dict):
        return {key: digits(item) for key, item in value.items()}
    if isinstance(value, list):
        return [digits(item) for item in value]
    return float(f"{value:.9g}") if isinstance(value, float) else value


def text(value, indent=""):
    """JSON with a line for everything that fits on one."""
    line = json.dumps(value)
    if not isinstance(value, dict) or len(indent) + len(line) <= 100:
        return line
    deeper = indent + "  "
    items = [f"{deeper}{json.dumps(key)}: {text(item, deeper)}" for key, item in value.items()]
    return "{\n" + ",\n".join(items) + "\n" + indent + "}"


def main():
    torch.set_num_threads(1)
    projected = zs_outputs(ZS2_PROJECTED)
    print(text(digits({
        "counts": counts(),
        "zs1": zs_outputs(ZS1_TINY),
        "zs2": zs_outputs(ZS2_TINY),
        "zs2_projected": {key: projected[key] for key in ("sizes", "h_content", "pose", "face", "losses")},
        "mix_stage": stage_outputs(STAGE_TINY),
        "classifier": classifier_outputs(),
        "step": {"zs1": zs_step(ZS1_TINY), "zs2": zs_step(ZS2_TINY), "zs2_projected": zs_step(ZS2_PROJECTED),
                 "mix_stage": stage_step(STAGE_TINY)},
    })))


if __name__ == "__main__":
    main()
