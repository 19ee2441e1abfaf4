#include "raster/images/text_module.h"

#include <ft2build.h>

#include <algorithm>
#include <memory>

#include FT_FREETYPE_H

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct EndLibrary {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct EndFace {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

// A font at a size. Nothing is fitted to the grid of pixels, so that letters keep their distances.
class Font {
  public:
    explicit Font(const TextStyle& style) {
        FT_Library library = nullptr;
        FT_Face face = nullptr;
        int problem = FT_Init_FreeType(&library);
        library_.reset(library);
        if (problem == 0) problem = FT_New_Face(library, style.font.c_str(), 0, &face);
        face_.reset(face);
        if (problem == 0) problem = FT_Set_Pixel_Sizes(face, 0, static_cast<unsigned>(style.size));
        if (problem != 0)
            throw Error(format("{}: is no font that can be used; install it again", style.font));
    }

    // Draws the letter so many 64ths of a pixel right of the grid, and leaves it in the slot.
    FT_GlyphSlot draw(char32_t letter, FT_Pos right) const {
        FT_Vector move{.x = right, .y = 0};
        FT_Set_Transform(face_.get(), nullptr, &move);
        if (FT_Load_Char(face_.get(), letter, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) != 0) return nullptr;
        return face_->glyph;
    }

  private:
    std::unique_ptr<FT_LibraryRec_, EndLibrary> library_;
    std::unique_ptr<FT_FaceRec_, EndFace> face_;  // goes before the library
};

// Where the next letter begins [1/64 px].
FT_Pos after(FT_Pos pen, FT_GlyphSlot letter) {
    return pen + letter->linearHoriAdvance / 1024;  // from 65536ths of a pixel
}

void put(Frame& frame, const FT_Bitmap& letter, int left, int top) {
    for (int y = 0; y < static_cast<int>(letter.rows); ++y) {
        for (int x = 0; x < static_cast<int>(letter.width); ++x) {
            if (left + x < 0 || left + x >= frame.width || top + y < 0 || top + y >= frame.height) continue;
            std::uint8_t& alpha =
                frame.rgba[static_cast<std::size_t>((top + y) * frame.width + left + x) * 4 + 3];
            const int both = alpha + letter.buffer[y * letter.pitch + x];
            alpha = static_cast<std::uint8_t>(std::min(255, both));
        }
    }
}

}  // namespace

int width_of_text(const std::u32string& line, const TextStyle& style) {
    const Font font(style);
    FT_Pos pen = 0;
    for (const char32_t letter : line)
        if (const FT_GlyphSlot drawn = font.draw(letter, 0)) pen = after(pen, drawn);
    return static_cast<int>((pen + 63) / 64);
}

Frame draw_text(const std::u32string& line, const TextStyle& style) {
    Frame frame{.width = width_of_text(line, style) + 1, .height = style.size * 3 / 2, .rgba = {}};
    frame.rgba.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 4, 0);
    const Font font(style);
    const int baseline = style.size * 9 / 8;
    FT_Pos pen = 0;
    for (const char32_t letter : line) {
        const FT_GlyphSlot drawn = font.draw(letter, pen % 64);
        if (drawn == nullptr) continue;
        put(frame, drawn->bitmap, static_cast<int>(pen / 64) + drawn->bitmap_left,
            baseline - drawn->bitmap_top);
        pen = after(pen, drawn);
    }
    return frame;
}

}  // namespace chironomia
