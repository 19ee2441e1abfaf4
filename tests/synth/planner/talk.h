// A talk of two minutes.
#pragma once

namespace chironomia::testing {

inline constexpr const char* kTalk = R"(
Good evening, everybody, and thank you for coming. Tonight I would like to talk about something that we all use every day, but that hardly anybody thinks about: the bicycle. It looks like a simple machine. Two wheels, a frame, a chain, and a person who pushes the pedals. But if you ask an engineer why it stays upright, you will hear five different answers.

Let me start with the history. The first bicycles had no pedals at all. People sat on a wooden beam and pushed themselves forward with their feet, like children do today on their balance bikes. Then somebody had a wonderful idea: he put the pedals directly on the front wheel. That made the machine faster, but it also made it dangerous, because the wheel had to be huge. If the rider hit a small stone, he flew over the top and landed on his face.

The solution was the chain. With a chain you can choose how often the wheel turns for every turn of the pedals, so both wheels could be the same size again. They called it the safety bicycle, and it changed the world. Suddenly women could travel alone. Farmers could visit the next village in the evening. Doctors reached their patients in half the time.

Why does it not fall over? Many people believe that the spinning wheels keep it upright, like a gyroscope. That is not wrong, but it is not the whole story either. Perhaps you remember learning to ride as a child. Your father ran behind you, he held the saddle, and at some moment he let go. What did you do? You turned the handlebar towards the side to which you were falling. You steered under your own weight. In fact, a bicycle can do this by itself. Push an empty bicycle down a hill, and it will happily roll along for a long time.

Of course, there is one more question: what comes next? Electric motors are everywhere now, and batteries become smaller and cheaper every year. Maybe in ten years we will all ride to work without getting tired. I am not sure whether that is a good thing, but I am certain that the two wheels will stay. Thank you very much.
)";

}  // namespace chironomia::testing
