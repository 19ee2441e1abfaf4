// Short talks of our own making, for tests and measurements that need speech of some length.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace chironomia::testing {

inline constexpr std::array<const char*, 14> kTalks = {
    "Good morning, everybody! Today I want to show you three simple ideas. The first one is very small, and you can "
    "try it at home. The second is bigger, because it needs two people. And the third? Well, maybe the third will "
    "change how you think about all of this.",
    "Look at this bridge. On this side there is a little village, and over there, on the other side, is the whole "
    "city. For a hundred years nobody could cross the river here. Then somebody built a round tower, and a flat road "
    "between them, and suddenly everything was possible.",
    "I am not sure that this is right. Perhaps the numbers went up because the summer was long. But they could also go "
    "down again! So what should we do? First, we wait. Second, we measure. And then, of course, we decide together.",
    "Thank you so much for coming! I am really happy to see you here. Please take a seat, and let me tell you what "
    "happened to me yesterday. I opened the door, and there was a huge box, as big as a table. And inside? Nothing! "
    "Nothing at all.",
    "There are two kinds of maps. One shows where things are. The other shows how to get there. Most people want the "
    "second, but they ask for the first. If you give them a map of places, they look at it, they turn it around, and "
    "they are still lost.",
    "Stop! Do not touch that. It looks cold, but it is terribly hot. You have to wait at least ten minutes. Then you "
    "take the small spoon, not the large one, and you stir it slowly, round and round, until all of it is smooth.",
    "My grandmother never wrote anything down. She knew every song, from the beginning to the end, and she sang them "
    "while she worked. When she died, we had only four of them left. That is why I record people. Old people, young "
    "people, everybody who still remembers.",
    "You may ask why a machine should move its hands at all. Because we listen with our eyes! When somebody says that "
    "a fish was big, we look at the hands, and not at the word. The hands tell us how big. And if they are late, even "
    "a little, we do not believe it.",
    "Let us compare the two plans. On the one hand, the old road is short, but it is steep and narrow. On the other "
    "hand, the new road is long, and it goes around the whole mountain. However, it is flat, it is wide, and nobody "
    "has ever had an accident there.",
    "Once upon a time there was a king who owned three clocks. The first was always early. The second was always late. "
    "And the third had stopped. Which one did he trust? The one that had stopped, he said, because it was right two "
    "times every day.",
    "I disagree. That was never the question! The question is who pays for it. Not you, not me, but our "
    "children, in twenty or thirty years. They will come and ask us: where were you? What did you do? And we "
    "will have no answer.",
    "Here is how you plant a tree. You dig a hole, this deep, and twice as wide as the roots. You put the tree in the "
    "middle, you hold it straight, and you fill in the earth. Then water, a lot of water. And after that you do the "
    "most difficult thing: you wait.",
    "Sorry, I did not hear you. Could you say that again? Ah, now I understand. Yes, you are absolutely right. We "
    "should have told everyone before. I apologise for that. Next time you will be the first to know, I promise.",
    "What is a conversation? One speaks, the other listens, and then they change. It sounds easy. But nobody tells "
    "them when. They see it in a look, in a breath, in a hand that goes down. And in less than a quarter of a second, "
    "the turn is over. Goodbye, and see you tomorrow!"};

// So many of them in a row, from talk `first` on.
inline std::string talk(std::size_t first, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += (text.empty() ? "" : "\n\n") + std::string(kTalks[(first + i) % kTalks.size()]);
    return text;
}

}  // namespace chironomia::testing
