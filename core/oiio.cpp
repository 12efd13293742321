// SPDX-License-Identifier: MIT
//
// The only C++ file, and the only one that knows OpenImageIO: all of bandlimit-images.so, which
// core/image_library.h describes. Every function that C calls catches exceptions and turns them
// into a status, or into NaN where it returns a value.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

extern "C" {
#include "core/colourspace.h"
#include "core/image_library.h"
#include "core/version.h"
}

namespace {

// --- writing ------------------------------------------------------------------------------------

// The finite range of the values, for pictures without a stated one. A constant image is black.
void range_of(const bl_image &image, size_t count, double &black, double &white) {
    black = image.black;
    white = image.white;
    if (black != white)
        return;
    bool first = true;
    for (size_t i = 0; i < count; i++) {
        const double value = image.values[i];
        if (!std::isfinite(value))
            continue;
        black = first ? value : std::fmin(black, value);
        white = first ? value : std::fmax(white, value);
        first = false;
    }
    if (black == white)
        white = black + 1;
}

template <typename Code>
std::vector<Code> codes_of(const bl_image &image, size_t count, double black, double white) {
    const double full = static_cast<Code>(~Code{0});
    std::vector<Code> codes(count);
    for (size_t i = 0; i < count; i++) {
        const double share = (image.values[i] - black) / (white - black);
        // fmax gives 0 for NaN, so the cast below always sees a number in [0, full + 0.5).
        const double inside = std::fmin(std::fmax(share, 0.0), 1.0);
        codes[i] = static_cast<Code>((image.srgb ? bl_srgb_encode(inside) : inside) * full + 0.5);
    }
    return codes;
}

std::string real_text(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

const char spacing_name[] = "bandlimit:spacing";

// TIFF has no room for names of our own; there the description holds a line "name=value" for each.
void put_attributes(const bl_image &image, bl_image_format format, OIIO::ImageSpec &spec) {
    std::string description;
    const auto put = [&](const std::string &name, const std::string &value) {
        spec.attribute(name, value);
        description += name + "=" + value + "\n";
    };
    if (image.spacing > 0)
        put(spacing_name, real_text(image.spacing));
    for (size_t i = 0; i < image.attribute_count; i++)
        put(image.attributes[i].name, image.attributes[i].value);
    if (format == BL_IMAGE_TIFF && !description.empty())
        spec.attribute("ImageDescription", description);
}

// The text of an attribute that put_attributes wrote, or `otherwise`.
std::string find_attribute(const OIIO::ImageSpec &spec, const std::string &name,
                           const std::string &otherwise) {
    if (spec.find_attribute(name))
        return std::string{spec.get_string_attribute(name)};
    const std::string description =
        "\n" + std::string{spec.get_string_attribute("ImageDescription")};
    const size_t at = description.find("\n" + name + "=");
    if (at == std::string::npos)
        return otherwise;
    const size_t from = at + name.size() + 2;
    return description.substr(from, description.find('\n', from) - from);
}

bool write_values(OIIO::ImageOutput &output, const bl_image &image, bl_image_format format,
                  size_t count) {
    if (format != BL_IMAGE_PNG)
        return output.write_image(OIIO::TypeDesc::FLOAT, image.values);
    double black, white;
    range_of(image, count, black, white);
    return image.bits == 16
               ? output.write_image(OIIO::TypeDesc::UINT16,
                                    codes_of<uint16_t>(image, count, black, white).data())
               : output.write_image(OIIO::TypeDesc::UINT8,
                                    codes_of<uint8_t>(image, count, black, white).data());
}

OIIO::ImageSpec spec_of(const bl_image &image, bl_image_format format, int channels) {
    const OIIO::TypeDesc type = format != BL_IMAGE_PNG ? OIIO::TypeDesc::FLOAT
                                : image.bits == 16     ? OIIO::TypeDesc::UINT16
                                                       : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), channels,
                         type);
    if (channels == 1)
        spec.channelnames = {"Y"};
    if (channels == 2 || channels == 4) { // numbers, none of them an opacity
        for (int i = 0; i < channels; i++)
            spec.channelnames[static_cast<size_t>(i)] = "component" + std::to_string(i);
        spec.alpha_channel = -1;
    }
    spec.attribute("compression", "zip");
    // Without a date OpenImageIO writes the time: the same image must have the same bytes.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (format == BL_IMAGE_PNG)
        spec.attribute("oiio:ColorSpace", "sRGB"); // codes are for the eye as they stand
    put_attributes(image, format, spec);
    return spec;
}

// The stream of a bl_file, as the image library wants to see it. The library may lose an error (its
// PNG writer does), so the first one stays here. TIFF reads back what it wrote; between reading and
// writing a stream wants to be placed anew.
class Stream : public OIIO::Filesystem::IOProxy {
  public:
    Stream(FILE *of_file, const char *name) : IOProxy(name, Write), stream(of_file) {
    }
    const char *proxytype() const override {
        return "stream";
    }
    size_t write(const void *bytes, size_t count) override {
        if (!go(m_pos, Last::write))
            return 0;
        const size_t done = std::fwrite(bytes, 1, count, stream);
        at = m_pos += static_cast<int64_t>(done);
        end = std::max(end, at);
        if (done < count)
            keep_reason();
        return done;
    }
    size_t read(void *bytes, size_t count) override {
        if (!go(m_pos, Last::read))
            return 0;
        const size_t done = std::fread(bytes, 1, count, stream);
        at = m_pos += static_cast<int64_t>(done);
        return done;
    }
    size_t pwrite(const void *bytes, size_t count, int64_t offset) override {
        const int64_t here = m_pos;
        m_pos = offset;
        const size_t done = write(bytes, count);
        m_pos = here;
        return done;
    }
    size_t pread(void *bytes, size_t count, int64_t offset) override {
        const int64_t here = m_pos;
        m_pos = offset;
        const size_t done = read(bytes, count);
        m_pos = here;
        return done;
    }
    size_t size() const override {
        return static_cast<size_t>(end);
    }
    int reason = 0; // errno of the first failure

  private:
    enum class Last { write, read };

    bool go(int64_t place, Last now) {
        if ((place != at || now != last) && fseeko(stream, place, SEEK_SET) != 0) {
            keep_reason();
            return false;
        }
        at = place;
        last = now;
        return true;
    }
    void keep_reason() {
        if (!reason)
            reason = errno ? errno : EIO;
    }

    FILE *stream;
    int64_t at = 0, end = 0; // the stream's own place; the bytes written
    Last last = Last::write;
};

// The image into the stream; what the library says of a failure goes into `reason`.
bool encode(Stream &stream, const char *path, bl_image_format format, const bl_image &image,
            std::string &reason) {
    const size_t channels = image.channels ? image.channels : 1;
    auto output = OIIO::ImageOutput::create(path);
    if (!output) {
        reason = OIIO::geterror();
        return false;
    }
    bool good = output->set_ioproxy(&stream) &&
                output->open(path, spec_of(image, format, static_cast<int>(channels)));
    good = good && write_values(*output, image, format, image.width * image.height * channels);
    good = output->close() && good;
    reason = output->geterror();
    return good;
}

bl_status write_image(FILE *file, const char *path, bl_image_format format, const bl_image &image,
                      bl_message *message) {
    Stream stream(file, path);
    std::string reason;
    if (encode(stream, path, format, image, reason) && !stream.reason)
        return BL_OK;
    if (stream.reason) // the system's own word says more than the library's
        reason = std::strerror(stream.reason);
    return bl_report(message, BL_DEVICE, "cannot write '%s': %s; nothing was changed there", path,
                     reason.empty() ? "the image library gives no reason" : reason.c_str());
}

// --- reading ------------------------------------------------------------------------------------

} // namespace

// The pixels of one channel: held in memory, or read in blocks through a cache of bounded size.
struct bl_pixels {
    bl_pixels(const OIIO::ImageSpec &spec, const char *file, int of_part, int of_channel)
        : width(static_cast<size_t>(spec.width)), height(static_cast<size_t>(spec.height)),
          left(spec.x), top(spec.y), part(of_part), channel(of_channel), path(file) {
    }
    ~bl_pixels() {
        if (cache)
            OIIO::ImageCache::destroy(cache, true);
    }
    bl_pixels(const bl_pixels &) = delete;
    bl_pixels &operator=(const bl_pixels &) = delete;

    void use_cache(size_t memory_bytes) {
        cache = OIIO::ImageCache::create(false);
        const float mebibytes = static_cast<float>(memory_bytes) / 1048576.0f;
        cache->attribute("max_memory_MB", std::fmax(mebibytes, 1.0f));
        cache->attribute("autotile", 64);
        cache->attribute("autoscanline", 1);
        cache->attribute("forcefloat", 1);
        cache->attribute("unassociatedalpha", 1);
    }

    // Pixels x .. x + count - 1 of row y, all within the image. NaN where the file fails us.
    void span(size_t x, size_t y, size_t count, float *out) const {
        if (!held.empty()) {
            std::memcpy(out, &held[y * width + x], count * sizeof *out);
            return;
        }
        const int x0 = left + static_cast<int>(x), y0 = top + static_cast<int>(y);
        if (!cache->get_pixels(path, part, 0, x0, x0 + static_cast<int>(count), y0, y0 + 1, 0, 1,
                               channel, channel + 1, OIIO::TypeDesc::FLOAT, out)) {
            (void)cache->geterror();
            for (size_t i = 0; i < count; i++)
                out[i] = NAN;
        }
        for (size_t i = 0; i < count; i++)
            out[i] = finished(out[i]);
    }

    // From a share of the full scale to a whole number, or from a code to light.
    template <typename Number> float finished(Number value) const {
        return static_cast<float>(whole_scale > 0 ? std::rint(value * whole_scale)
                                  : space.curve == BL_COLOURS_LINEAR
                                      ? value
                                      : bl_colourspace_decode(&space, value));
    }

    const size_t width, height;
    std::vector<float> held;
    double whole_scale = 0; // of integers that stay as they are; 0: none
    bl_colourspace space = {BL_COLOURS_LINEAR, 0};

  private:
    const int left, top, part, channel;
    const OIIO::ustring path;
    OIIO::ImageCache *cache = nullptr;
};

namespace {

bl_status check_file(const char *path, bl_message *message) {
    struct stat info;
    if (stat(path, &info) != 0)
        return bl_report(message, BL_DEVICE, "cannot read '%s': %s", path, std::strerror(errno));
    if (S_ISDIR(info.st_mode))
        return bl_report(message, BL_DEVICE, "cannot read '%s': it is a folder; name a file", path);
    if (!S_ISREG(info.st_mode))
        return bl_report(message, BL_DEVICE,
                         "cannot read '%s': it is not a file but a device or a pipe", path);
    if (access(path, R_OK) != 0)
        return bl_report(message, BL_DEVICE, "cannot read '%s': %s", path, std::strerror(errno));
    if (info.st_size == 0)
        return bl_report(message, BL_DEVICE, "cannot read '%s': the file is empty", path);
    return BL_OK;
}

bl_status report_reading(const char *path, std::string reason, bl_message *message) {
    for (char &c : reason)
        c = c == '\n' ? ' ' : c;
    return bl_report(message, BL_DEVICE, "cannot read '%s': %s", path,
                     reason.empty() ? "it is damaged or not an image" : reason.c_str());
}

// Goes to the part asked for. A file of several parts needs one named: the first may be any layer.
bl_status seek_part(OIIO::ImageInput &input, const bl_pixels_choice &choice, int &part,
                    bl_message *message) {
    int parts = 1;
    while (input.seek_subimage(parts, 0))
        parts++;
    (void)input.geterror();
    part = choice.part < 0 ? 0 : choice.part;
    if (choice.part < 0 && parts > 1)
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %d parts; choose one with part=0 to part=%d", choice.path, parts,
                         parts - 1);
    if (part >= parts)
        return bl_report(message, BL_USAGE, "part=%d of '%s': the file has %d part%s, from 0", part,
                         choice.path, parts, parts == 1 ? "" : "s");
    if (!input.seek_subimage(part, 0))
        return report_reading(choice.path, input.geterror(), message);
    return BL_OK;
}

bl_status find_channel(const OIIO::ImageSpec &spec, const bl_pixels_choice &choice, int &channel,
                       bl_message *message) {
    channel = 0;
    if (!choice.channel)
        return BL_OK;
    channel = spec.channelindex(choice.channel);
    if (channel < 0 && choice.channel_index < spec.nchannels)
        channel = choice.channel_index;
    if (channel >= 0)
        return BL_OK;
    std::string names;
    for (int i = 0; i < spec.nchannels; i++)
        names += (i ? ", " : "") + std::string(spec.channel_name(i));
    return bl_report(message, BL_USAGE, "no channel '%s' in '%s'; it has %s (or 0 to %d)",
                     choice.channel, choice.path, names.c_str(), spec.nchannels - 1);
}

bl_status check_shape(const OIIO::ImageSpec &spec, const char *path, bl_message *message) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        return bl_report(message, BL_MISMATCH, "'%s' has no pixels: %d x %d with %d channels", path,
                         spec.width, spec.height, spec.nchannels);
    if (spec.deep || spec.depth > 1)
        return bl_report(message, BL_MISMATCH,
                         "'%s' is %s; only images of one plane of pixels can be read%s", path,
                         spec.deep ? "a deep image" : "a volume",
                         spec.deep ? "" : " (and volumes as bare samples, .raw)");
    return BL_OK;
}

// The full scale of integers of this type; 0 of floats.
double full_scale_of(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
        return 0xff;
    case OIIO::TypeDesc::INT8:
        return 0x7f;
    case OIIO::TypeDesc::UINT16:
        return 0xffff;
    case OIIO::TypeDesc::INT16:
        return 0x7fff;
    case OIIO::TypeDesc::UINT32:
        return 0xffffffff;
    case OIIO::TypeDesc::INT32:
        return 0x7fffffff;
    case OIIO::TypeDesc::UINT64:
        return 0x1p64;
    case OIIO::TypeDesc::INT64:
        return 0x1p63;
    default:
        return 0;
    }
}

// How the codes of a file stand for light, where that is asked for; and why it is taken so.
bl_status find_colourspace(const OIIO::ImageSpec &spec, const char *path,
                           const bl_colourspace &asked, bl_colourspace &space, std::string &why,
                           bl_message *message) {
    const std::string word{spec.get_string_attribute("oiio:ColorSpace")};
    space = asked;
    why = "as asked";
    if (asked.curve != BL_COLOURS_OF_FILE)
        return BL_OK;
    why = "the file says " + word;
    if (word.empty()) {
        const double full = full_scale_of(spec.format);
        space = {full > 0 && full <= 0xff ? BL_COLOURS_SRGB : BL_COLOURS_LINEAR, 0};
        why = space.curve == BL_COLOURS_SRGB ? "assumed of 8 bits, the file says nothing"
                                             : "assumed, the file says nothing";
    } else if (!bl_colourspace_of_file(word.c_str(), spec.get_float_attribute("oiio:Gamma"),
                                       &space)) {
        return bl_report(message, BL_MISMATCH,
                         "'%s' says that its colours are '%s', which is not known here; give "
                         "colourspace=linear, srgb or a power",
                         path, word.c_str());
    }
    return BL_OK;
}

std::string text_of(const bl_colourspace &space) {
    char text[64];
    bl_colourspace_text(&space, text, sizeof text);
    return text;
}

bool is_colour(const OIIO::ImageSpec &spec, int channel) {
    return channel != spec.alpha_channel && channel != spec.z_channel;
}

// Rows y to end - 1 of one channel. Scanlines are read one by one: the library's way of reading
// several at once does not notice when a TIFF ends early (OpenImageIO pull request 5336).
template <typename Number>
bool read_rows(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, int part, int channel, int y,
               int end, Number *out) {
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<Number>::value;
    if (spec.tile_width)
        return input.read_tiles(part, 0, spec.x, spec.x + spec.width, y, end, spec.z, spec.z + 1,
                                channel, channel + 1, type, out);
    for (int line = y; line < end; line++, out += spec.width)
        if (!input.read_scanlines(part, 0, line, line + 1, spec.z, channel, channel + 1, type, out))
            return false;
    return true;
}

// Reads all rows once in strips, which finds a damaged file now, and keeps them if asked to. Whole
// numbers come through doubles, which hold them.
template <typename Number>
bl_status read_all(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, int part, int channel,
                   bool keep, const char *path, bl_pixels &pixels, bl_message *message) {
    const int lines = spec.tile_width ? spec.tile_height : 64;
    std::vector<Number> strip(pixels.width * static_cast<size_t>(lines));
    if (keep)
        pixels.held.resize(pixels.width * pixels.height);
    for (int y = spec.y; y < spec.y + spec.height; y += lines) {
        const int end = std::min(y + lines, spec.y + spec.height);
        if (!read_rows(input, spec, part, channel, y, end, strip.data()))
            return report_reading(path, input.geterror(), message);
        if (!keep)
            continue;
        float *const held = &pixels.held[static_cast<size_t>(y - spec.y) * pixels.width];
        const size_t count = pixels.width * static_cast<size_t>(end - y);
        for (size_t i = 0; i < count; i++)
            held[i] = pixels.finished(strip[i]);
    }
    return BL_OK;
}

// What the values of a channel are.
bl_status describe_channel(const OIIO::ImageSpec &spec, const bl_pixels_choice &choice, int channel,
                           bl_pixels &pixels, bl_pixels_facts &facts, bl_message *message) {
    const OIIO::TypeDesc type = spec.channelformat(channel);
    const double full = full_scale_of(type);
    std::string text = std::string{type.c_str()} + " of the channel " +
                       std::string{spec.channel_name(channel)} + ", as stored";
    if (full > 0xffff) {
        pixels.whole_scale = full;
    } else {
        std::string why;
        if (full > 0)
            text += " over " + std::to_string(static_cast<int>(full));
        if (is_colour(spec, channel)) {
            const bl_status status =
                find_colourspace(spec, choice.path, choice.colourspace, pixels.space, why, message);
            if (status != BL_OK)
                return status;
        }
        if (pixels.space.curve != BL_COLOURS_LINEAR)
            text += ", made linear from " + text_of(pixels.space) + " (" + why + ")";
        else if (full > 0 && choice.colourspace.curve == BL_COLOURS_LINEAR)
            text += "; colourspace=file would make light of colours";
    }
    std::snprintf(facts.note, sizeof facts.note, "%s", text.c_str());
    return BL_OK;
}

bl_status open_pixels(const bl_pixels_choice &choice, bl_pixels **out, bl_pixels_facts &facts,
                      bl_message *message) {
    bl_status status = check_file(choice.path, message);
    if (status != BL_OK)
        return status;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // values as stored, not times alpha
    auto input = OIIO::ImageInput::open(choice.path, &hints);
    if (!input)
        return report_reading(choice.path, OIIO::geterror(), message);
    int part, channel;
    if ((status = seek_part(*input, choice, part, message)) != BL_OK)
        return status;
    const OIIO::ImageSpec spec = input->spec();
    if ((status = check_shape(spec, choice.path, message)) != BL_OK ||
        (status = find_channel(spec, choice, channel, message)) != BL_OK)
        return status;
    auto pixels = std::make_unique<bl_pixels>(spec, choice.path, part, channel);
    const double bytes = 4.0 * spec.width * spec.height;
    const bool keep = bytes <= static_cast<double>(choice.memory_bytes);
    status = describe_channel(spec, choice, channel, *pixels, facts, message);
    if (status != BL_OK)
        return status;
    status =
        pixels->whole_scale > 0
            ? read_all<double>(*input, spec, part, channel, keep, choice.path, *pixels, message)
            : read_all<float>(*input, spec, part, channel, keep, choice.path, *pixels, message);
    if (status != BL_OK)
        return status;
    if (!keep)
        pixels->use_cache(choice.memory_bytes);
    facts.width = pixels->width;
    facts.height = pixels->height;
    std::snprintf(facts.spacing, sizeof facts.spacing, "%s",
                  find_attribute(spec, spacing_name, "").c_str());
    *out = pixels.release();
    return BL_OK;
}

// --- pictures for textures ----------------------------------------------------------------------

// Linear colours in memory, row 0 at the top.
struct Picture {
    size_t width = 0, height = 0;
    std::vector<float> rgb;
    double mean[3] = {0, 0, 0}, least[3], most[3];
    std::string note; // how the colours were read
};

const char picture_name[] = "bandlimit:picture"; // of the attribute with its address

// What the texture system reads a picture through: it asks for a file by name, and gets what is in
// memory, which is linear already.
class PictureInput : public OIIO::ImageInput {
  public:
    const char *format_name() const override {
        return "bandlimit";
    }
    bool open(const std::string &, OIIO::ImageSpec &) override {
        return false; // there is nothing without the address
    }
    bool open(const std::string &, OIIO::ImageSpec &spec, const OIIO::ImageSpec &config) override {
        const OIIO::ParamValue *address =
            config.find_attribute(picture_name, OIIO::TypeDesc(OIIO::TypeDesc::PTR));
        if (!address)
            return false;
        std::memcpy(&picture, address->data(), sizeof picture);
        m_spec = OIIO::ImageSpec(static_cast<int>(picture->width),
                                 static_cast<int>(picture->height), 3, OIIO::TypeDesc::FLOAT);
        spec = m_spec;
        return true;
    }
    bool close() override {
        return true;
    }
    bool read_native_scanline(int, int, int y, int, void *data) override {
        const size_t row = 3 * picture->width;
        std::memcpy(data, &picture->rgb[static_cast<size_t>(y) * row], row * sizeof(float));
        return true;
    }

  private:
    const Picture *picture = nullptr;
};

OIIO::ImageInput *make_picture_input() {
    return new PictureInput;
}

// Squares of 16, 8, 4 and 2 texels in the columns from left to right, each with a colour of its own
// that the numbers of its column and row make, over a ramp of grey.
void draw_card(Picture &picture) {
    constexpr size_t side = 128;
    picture.width = picture.height = side;
    picture.rgb.resize(3 * side * side);
    for (size_t y = 0; y < side; y++)
        for (size_t x = 0; x < side; x++) {
            const size_t square = 16u >> (x / 32), i = x / square, j = y / square;
            const size_t pattern = (i * 3 + j * 5) % 8;
            for (size_t c = 0; c < 3; c++)
                picture.rgb[3 * (side * y + x) + c] =
                    y >= side - 16 ? static_cast<float>(x) / static_cast<float>(side - 1)
                                   : ((pattern >> c) & 1 ? 0.8f : 0.05f);
        }
}

bl_status read_picture(const char *path, const bl_colourspace &asked, Picture &picture,
                       bl_message *message) {
    bl_status status = check_file(path, message);
    if (status != BL_OK)
        return status;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // codes are decoded as stored, not times alpha
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input)
        return report_reading(path, OIIO::geterror(), message);
    const OIIO::ImageSpec spec = input->spec();
    if ((status = check_shape(spec, path, message)) != BL_OK)
        return status;
    if (static_cast<double>(spec.width) * spec.height > 0x1p28)
        return bl_report(message, BL_DEVICE, "'%s' has %d x %d texels; a picture has 2^28 at most",
                         path, spec.width, spec.height);
    const size_t width = static_cast<size_t>(spec.width), height = static_cast<size_t>(spec.height);
    const int channels = spec.nchannels >= 3 ? 3 : 1;
    std::vector<float> read(width * height * static_cast<size_t>(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, read.data()))
        return report_reading(path, input->geterror(), message);
    bl_colourspace space;
    std::string why;
    if ((status = find_colourspace(spec, path, asked, space, why, message)) != BL_OK)
        return status;
    picture.note =
        (space.curve == BL_COLOURS_LINEAR ? "linear" : "made linear from " + text_of(space)) +
        " (" + why + ")" +
        (spec.alpha_channel >= 0 ? "; alpha is left aside, colours are as stored" : "");
    picture.width = width;
    picture.height = height;
    picture.rgb.resize(3 * width * height);
    for (size_t i = 0; i < picture.rgb.size(); i++) {
        const double code = read[channels == 3 ? i : i / 3];
        picture.rgb[i] = static_cast<float>(bl_colourspace_decode(&space, code));
    }
    return BL_OK;
}

void measure_picture(Picture &picture) {
    const size_t count = picture.width * picture.height;
    for (size_t c = 0; c < 3; c++) {
        picture.least[c] = picture.most[c] = picture.rgb[c];
        for (size_t i = 0; i < count; i++) {
            const double value = picture.rgb[3 * i + c];
            picture.mean[c] += value;
            picture.least[c] = std::fmin(picture.least[c], value);
            picture.most[c] = std::fmax(picture.most[c], value);
        }
        picture.mean[c] /= static_cast<double>(count);
    }
}

} // namespace

// The signal's own texture system: nothing is shared, so nothing is left when it goes. Threads take
// turns at it with one state: the cache of the library counts the memory of its tiles wrongly when
// threads fill it at once, and ends the program for it.
struct bl_texels {
    Picture picture;
    OIIO::TextureSystem *system = nullptr;
    OIIO::TextureSystem::TextureHandle *handle = nullptr;
    OIIO::TextureSystem::Perthread *state = nullptr;
    mutable std::mutex turn;

    bl_texels() = default;
    bl_texels(const bl_texels &) = delete;
    bl_texels &operator=(const bl_texels &) = delete;
    ~bl_texels() {
        if (state)
            system->destroy_thread_info(state);
        if (system)
            OIIO::TextureSystem::destroy(system, true);
    }
};

namespace {

bl_status open_texels(const char *path, const bl_colourspace &space, bl_texels **out,
                      bl_message *message) {
    auto texels = std::make_unique<bl_texels>();
    if (*path) {
        bl_status status = read_picture(path, space, texels->picture, message);
        if (status != BL_OK)
            return status;
    } else {
        draw_card(texels->picture);
        texels->picture.note = "linear, of the built-in card";
    }
    measure_picture(texels->picture);
    texels->system = OIIO::TextureSystem::create(false);
    texels->state = texels->system->create_thread_info();
    texels->system->attribute("automip", 1);
    texels->system->attribute("autotile", 64);
    texels->system->attribute("forcefloat", 1);
    texels->system->attribute("max_memory_MB", 4096.0f); // pages are taken as they are used
    OIIO::ImageSpec config;
    const Picture *address = &texels->picture;
    config.attribute(picture_name, OIIO::TypeDesc(OIIO::TypeDesc::PTR), &address);
    const OIIO::ustring name("bandlimit picture");
    OIIO::ImageCache *cache = texels->system->imagecache();
    if (!cache->add_file(name, make_picture_input, &config) ||
        !(texels->handle = texels->system->get_texture_handle(name)) ||
        !texels->system->good(texels->handle))
        return report_reading(*path ? path : "the built-in card", texels->system->geterror(),
                              message);
    *out = texels.release();
    return BL_OK;
}

// A place of the unit square, in float as the library wants it.
float fraction_of(double x) {
    return static_cast<float>(x - std::floor(x));
}

void look(const bl_texels &texels, double s, double t, double width_s, double width_t,
          bl_texels_reading reading, double rgb[3]) {
    OIIO::TextureOpt options;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.mipmode = reading == BL_TEXELS_POINT       ? OIIO::TextureOpt::MipModeNoMIP
                      : reading == BL_TEXELS_TRILINEAR ? OIIO::TextureOpt::MipModeTrilinear
                                                       : OIIO::TextureOpt::MipModeAniso;
    // More than all of the picture is all of it; so is a width that a float does not hold.
    const float across = static_cast<float>(std::fmin(width_s, 1e6));
    const float down = static_cast<float>(std::fmin(width_t, 1e6));
    float result[3] = {NAN, NAN, NAN};
    const std::lock_guard<std::mutex> guard(texels.turn);
    if (!texels.system->texture(texels.handle, texels.state, options, fraction_of(s),
                                fraction_of(t), across, 0.0f, 0.0f, down, 3, result))
        (void)texels.system->geterror();
    for (int c = 0; c < 3; c++)
        rgb[c] = static_cast<double>(result[c]);
}

// Called from C, which no exception may pass.
template <typename Work>
bl_status catching(const char *path, bl_message *message, const Work &work) try {
    return work();
} catch (const std::exception &thrown) {
    return bl_report(message, BL_DEVICE, "'%s': the image library failed: %s", path, thrown.what());
} catch (...) {
    return bl_report(message, BL_DEVICE, "'%s': the image library failed", path);
}

bl_status write(FILE *stream, const char *path, bl_image_format format, const bl_image *image,
                bl_message *message) {
    return catching(path, message,
                    [&] { return write_image(stream, path, format, *image, message); });
}

bl_status pixels_open(const bl_pixels_choice *choice, bl_pixels **pixels, bl_pixels_facts *facts,
                      bl_message *message) {
    return catching(choice->path, message,
                    [&] { return open_pixels(*choice, pixels, *facts, message); });
}

void pixels_span(const bl_pixels *pixels, size_t x, size_t y, size_t count, float *out) try {
    pixels->span(x, y, count, out);
} catch (...) {
    std::fill_n(out, count, NAN);
}

void pixels_close(bl_pixels *pixels) {
    delete pixels;
}

bl_status texels_open(const char *path, const bl_colourspace *space, bl_texels **texels,
                      bl_message *message) {
    return catching(path, message, [&] { return open_texels(path, *space, texels, message); });
}

void texels_close(bl_texels *texels) {
    delete texels;
}

void texels_look(const bl_texels *texels, double s, double t, double width_s, double width_t,
                 bl_texels_reading reading, double rgb[3]) try {
    rgb[0] = rgb[1] = rgb[2] = NAN;
    if (std::isfinite(s) && std::isfinite(t) && width_s >= 0 && width_t >= 0)
        look(*texels, s, t, width_s, width_t, reading, rgb);
} catch (...) {
    rgb[0] = rgb[1] = rgb[2] = NAN;
}

void texels_mean(const bl_texels *texels, double rgb[3]) {
    std::copy_n(texels->picture.mean, 3, rgb);
}

void texels_bounds(const bl_texels *texels, double least[3], double most[3]) {
    std::copy_n(texels->picture.least, 3, least);
    std::copy_n(texels->picture.most, 3, most);
}

void texels_size(const bl_texels *texels, size_t size[2]) {
    size[0] = texels->picture.width;
    size[1] = texels->picture.height;
}

const char *texels_note(const bl_texels *texels) {
    return texels->picture.note.c_str();
}

void texels_plane(const bl_texels *texels, int component, float *out) {
    const std::vector<float> &rgb = texels->picture.rgb;
    for (size_t i = static_cast<size_t>(component); i < rgb.size(); i += 3)
        *out++ = rgb[i];
}

} // namespace

// BL_IMAGE_LIBRARY_SYMBOL, all that this shared object exports.
extern "C" __attribute__((visibility("default"))) const bl_image_library bl_image_library_table = {
    BL_VERSION,  write,       pixels_open,   pixels_span, pixels_close, texels_open, texels_close,
    texels_look, texels_mean, texels_bounds, texels_size, texels_note,  texels_plane};
