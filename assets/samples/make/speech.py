"""Text -> speech and its words, through the espeak-ng library.

The library reports, while it speaks, where each word and each phoneme begins; from these come the
word times that the gestures are timed by. Times are seconds from the start of the written sound.
"""

import ctypes
import functools
import wave
from dataclasses import dataclass

import numpy as np

EVENT_END, EVENT_WORD, EVENT_PHONEME = 0, 1, 7
OUTPUT_SYNCHRONOUS = 2
WANT_PHONEMES, WANT_IPA = 1, 2
RATE, PITCH, RANGE, WORD_GAP = 1, 3, 4, 7
UTF8 = 1
VOWELS = "aeiouæɑɒɔəɚɛɜɪʊʌɐᵻ"


@dataclass
class Voice:
    name: str = "en-us"
    words_per_minute: int = 160
    pitch: int = 46  # 0..100
    pitch_range: int = 62  # 0..100
    word_gap: int = 1  # units of 10 ms


@dataclass
class Word:
    text: str
    start: float  # [s]
    end: float  # [s]
    vowels: list  # onset of each vowel [s]


@dataclass
class Speech:
    samples: np.ndarray  # (N,) int16
    rate: int  # [Hz]
    words: list

    @property
    def duration(self):
        return len(self.samples) / self.rate

    def accent(self, word, vowel=0, occurrence=0):
        """Onset of a vowel of the word: where a stroke should land [s]."""
        found = [w for w in self.words if w.text.lower() == word]
        return found[occurrence].vowels[vowel]


class _Id(ctypes.Union):
    _fields_ = [("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8)]


class _Event(ctypes.Structure):
    _fields_ = [
        ("type", ctypes.c_int),
        ("identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_ms", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user", ctypes.c_void_p),
        ("id", _Id),
    ]


_CALLBACK = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event)
)


def speak(text, voice, lead_in, tail):
    """Speech of `text` with `lead_in` and `tail` seconds of silence around it."""
    sound, events, rate = _synthesize(text, voice)
    lead = int(round(lead_in * rate))
    quiet = np.zeros(int(round(tail * rate)), np.int16)
    spoken_end = (len(sound) + lead) / rate
    samples = np.concatenate([np.zeros(lead, np.int16), sound, quiet])
    shifted = [(kind, at, length, (sample + lead) / rate, name) for kind, at, length, sample, name in events]
    return Speech(samples, rate, _words(text, shifted, spoken_end))


def write_wav(path, speech):
    with wave.open(str(path), "wb") as out:
        out.setnchannels(1)
        out.setsampwidth(2)
        out.setframerate(speech.rate)
        out.writeframes(speech.samples.astype("<i2").tobytes())


def write_words(path, speech):
    lines = ["word,start_s,end_s"]
    lines += [f"{w.text},{w.start:.3f},{w.end:.3f}" for w in speech.words]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


@functools.cache
def _library():
    """The library, started once: it does not survive a second start in one process."""
    library = ctypes.CDLL("libespeak-ng.so.1")
    rate = library.espeak_Initialize(OUTPUT_SYNCHRONOUS, 0, None, WANT_PHONEMES | WANT_IPA)
    if rate <= 0:
        raise RuntimeError("espeak-ng does not start; install the package espeak-ng")
    return library, rate


def _synthesize(text, voice):
    library, rate = _library()
    chunks, events = [], []

    def collect(sound, count, event):
        if sound and count > 0:
            chunks.append(np.ctypeslib.as_array(sound, (count,)).copy())
        index = 0
        while event and event[index].type != EVENT_END:
            e = event[index]
            name = e.id.string.decode("utf-8", "replace") if e.type == EVENT_PHONEME else ""
            events.append((e.type, e.text_position - 1, e.length, e.sample, name))
            index += 1
        return 0

    callback = _CALLBACK(collect)
    library.espeak_SetSynthCallback(callback)
    if library.espeak_SetVoiceByName(voice.name.encode()) != 0:
        raise RuntimeError(f"espeak-ng has no voice {voice.name}")
    settings = {
        RATE: voice.words_per_minute,
        PITCH: voice.pitch,
        RANGE: voice.pitch_range,
        WORD_GAP: voice.word_gap,
    }
    for parameter, value in settings.items():
        library.espeak_SetParameter(parameter, value, 0)
    encoded = text.encode("utf-8")
    library.espeak_Synth(encoded, len(encoded) + 1, 0, 1, 0, UTF8, None, None)
    library.espeak_Synchronize()
    return np.concatenate(chunks), events, rate


def _words(text, events, spoken_end):
    """Words from the events; a word ends where the next word or a pause begins."""
    words = []
    for kind, at, length, time, name in events:
        if kind == EVENT_WORD and length > 0:
            _close(words, time)
            words.append(Word(text[at : at + length].strip(".,!?;: "), time, None, []))
        elif kind == EVENT_PHONEME and words and words[-1].end is None:
            if name == "":
                _close(words, time)
            elif name[0] in VOWELS:
                words[-1].vowels.append(time)
    _close(words, spoken_end)
    return words


def _close(words, time):
    if words and words[-1].end is None:
        words[-1].end = time
