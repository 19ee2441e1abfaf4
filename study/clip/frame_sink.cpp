#include "study/clip/frame_sink.h"

#include <algorithm>

#include "core/cores.h"
#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/images/frame_stack.h"
#include "raster/images/image_file.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

// Before anything is drawn: the folder is replaced as a whole, and the one that the program works in cannot be.
FrameStack new_stack(const fs::path& pattern) {
    FrameStack stack = parse_stack_pattern(pattern);
    const fs::path folder = stack.folder.empty() ? "." : stack.folder;
    std::error_code problem;
    const bool works_here = fs::equivalent(folder, fs::current_path(), problem);
    const bool holds_something = fs::is_directory(folder, problem) && !fs::is_empty(folder, problem);
    if (works_here || holds_something) {
        const std::string another = (stack.folder / "frames" / pattern.filename()).string();
        throw Error(format("{}: frames get a new folder of their own, and {} {}", pattern.string(),
                           folder.string(),
                           works_here ? format("is the one you are in; write them like {}", another)
                                      : "already holds something; remove it, or name another one"));
    }
    return stack;
}

// A stack grows in a hidden folder beside its own, which it replaces in one move at the end.
struct StackWriter {
    StackWriter(const ClipJob& job)
        : stack(new_stack(job.out)), folder(stack.folder, PendingOutput::Kind::folder) {
        stack.folder = folder.path();
    }

    FrameStack stack;
    PendingOutput folder;
};

std::size_t writers_at_once(const ClipJob& job) {
    return static_cast<std::size_t>(job.threads > 0 ? job.threads : available_cores());
}

}  // namespace

struct FrameSink::Target {
    std::optional<ClipWriter> clip;
    std::optional<StackWriter> stack;
    std::size_t at_once = 1;  // frames under way: an encoder takes them one after the other
};

FrameSink::FrameSink(const ClipJob& job, const std::optional<Audio>& sound)
    : target_(std::make_unique<Target>()) {
    if (is_stack_pattern(job.out)) {
        target_->stack.emplace(job);
        target_->at_once = writers_at_once(job);
    } else {
        target_->clip.emplace(job.out, ClipSpec{.size = job.size, .fps = job.fps}, sound);
    }
}

FrameSink::~FrameSink() {
    for (const std::future<void>& task : under_way_) task.wait();
}

void FrameSink::write(Frame frame) {
    while (under_way_.size() >= target_->at_once) finish_oldest();
    const auto write_now = [target = target_.get(), number = written_, frame = std::move(frame)] {
        if (target->clip) {
            target->clip->write(frame);
        } else {
            write_image(target->stack->stack.file(number), frame);
        }
    };
    under_way_.push_back(std::async(std::launch::async, write_now));
    ++written_;
}

// Of what is under way nothing was asked for its result yet, so that the end can wait for all of it.
void FrameSink::finish_oldest() {
    std::future<void> oldest = std::move(under_way_.front());
    under_way_.pop_front();
    oldest.get();
}

void FrameSink::finish() {
    while (!under_way_.empty()) finish_oldest();
    if (target_->clip) {
        target_->clip->finish();
    } else {
        target_->stack->folder.commit();
    }
}

}  // namespace chironomia::study
