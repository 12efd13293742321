// SPDX-License-Identifier: MIT
//
// The only C++ file, and the only one that knows OpenImageIO. Every function that C calls catches
// what is thrown and turns it into a status, or into NaN where a value is asked for.
#include <algorithm>
#include <cctype>
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
#include "core/file.h"
#include "core/grammar.h"
#include "core/texels.h"
#include "core/image.h"
#include "sources/sampled_grid.h"
}

namespace {

// --- writing ------------------------------------------------------------------------------------

enum class Format { none, exr, tiff, png };

Format format_of(const std::string &path) {
    const size_t dot = path.find_last_of("./");
    if (dot == std::string::npos || path[dot] != '.')
        return Format::none;
    std::string ending = path.substr(dot + 1);
    for (char &c : ending)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending == "exr"                       ? Format::exr
           : ending == "png"                     ? Format::png
           : ending == "tif" || ending == "tiff" ? Format::tiff
                                                 : Format::none;
}

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

// The curve of IEC 61966-2-1 and its inverse, on [0, 1].
double encode_srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decode_srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

template <typename Code>
std::vector<Code> codes_of(const bl_image &image, size_t count, double black, double white) {
    const double full = static_cast<Code>(~Code{0});
    std::vector<Code> codes(count);
    for (size_t i = 0; i < count; i++) {
        const double share = (image.values[i] - black) / (white - black);
        // fmax gives 0 for NaN, so the cast below always sees a number in [0, full + 0.5).
        const double inside = std::fmin(std::fmax(share, 0.0), 1.0);
        codes[i] = static_cast<Code>((image.srgb ? encode_srgb(inside) : inside) * full + 0.5);
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
void put_attributes(const bl_image &image, Format format, OIIO::ImageSpec &spec) {
    std::string description;
    const auto put = [&](const std::string &name, const std::string &value) {
        spec.attribute(name, value);
        description += name + "=" + value + "\n";
    };
    if (image.spacing > 0)
        put(spacing_name, real_text(image.spacing));
    for (size_t i = 0; i < image.attribute_count; i++)
        put(image.attributes[i].name, image.attributes[i].value);
    if (format == Format::tiff && !description.empty())
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

bool write_values(OIIO::ImageOutput &output, const bl_image &image, Format format, size_t count) {
    if (format != Format::png)
        return output.write_image(OIIO::TypeDesc::FLOAT, image.values);
    double black, white;
    range_of(image, count, black, white);
    return image.bits == 16
               ? output.write_image(OIIO::TypeDesc::UINT16,
                                    codes_of<uint16_t>(image, count, black, white).data())
               : output.write_image(OIIO::TypeDesc::UINT8,
                                    codes_of<uint8_t>(image, count, black, white).data());
}

OIIO::ImageSpec spec_of(const bl_image &image, Format format, int channels) {
    const OIIO::TypeDesc type = format != Format::png ? OIIO::TypeDesc::FLOAT
                                : image.bits == 16    ? OIIO::TypeDesc::UINT16
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
    if (format == Format::png)
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

bl_status check_image(const char *path, const bl_image &image, bl_message *message) {
    const size_t channels = image.channels ? image.channels : 1;
    const size_t most = 1 << 24; // pixels along a side: beyond it no format here can hold them
    if (format_of(path) == Format::none)
        return bl_report(message, BL_USAGE,
                         "cannot tell the format of '%s': the name must end in .exr, .png or .tif",
                         path);
    if (!image.width || !image.height || image.width > most || image.height > most)
        return bl_report(message, BL_USAGE, "'%s': no image has %zu x %zu pixels", path,
                         image.width, image.height);
    if (channels > 4 || (format_of(path) == Format::png && channels % 2 == 0) ||
        (image.bits && image.bits != 8 && image.bits != 16))
        return bl_report(message, BL_USAGE,
                         "'%s': an image has 1 to 4 channels, PNG 1 or 3, and 8 or 16 bits", path);
    return BL_OK;
}

// The image into the stream; what the library says of a failure goes into `reason`.
bool encode(Stream &stream, const char *path, const bl_image &image, std::string &reason) {
    const Format format = format_of(path);
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

bl_status write_image(const char *path, const bl_image &image, bl_message *message) {
    bl_file file;
    bl_status status = check_image(path, image, message);
    if (status == BL_OK)
        status = bl_file_create(path, &file, message);
    if (status != BL_OK)
        return status;
    const std::unique_ptr<bl_file, void (*)(bl_file *)> discard(&file, bl_file_discard);
    Stream stream(file.stream, path);
    std::string reason;
    const bool good = encode(stream, path, image, reason);
    if (good && !stream.reason)
        return bl_file_commit(&file, message); // after which nothing is left to discard
    if (stream.reason)                         // the system's own word says more than the library's
        reason = std::strerror(stream.reason);
    return bl_report(message, BL_DEVICE, "cannot write '%s': %s; nothing was changed there", path,
                     reason.empty() ? "the image library gives no reason" : reason.c_str());
}

// --- reading ------------------------------------------------------------------------------------

// The pixels of one channel: held in memory, or read in blocks through a cache of bounded size.
class Pixels {
  public:
    Pixels(const OIIO::ImageSpec &spec, const char *file, int of_part, int of_channel)
        : width(static_cast<size_t>(spec.width)), height(static_cast<size_t>(spec.height)),
          left(spec.x), top(spec.y), part(of_part), channel(of_channel), path(file) {
    }
    ~Pixels() {
        if (cache)
            OIIO::ImageCache::destroy(cache, true);
    }
    Pixels(const Pixels &) = delete;
    Pixels &operator=(const Pixels &) = delete;

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
    }

    const size_t width, height;
    std::vector<float> held;

  private:
    const int left, top, part, channel;
    const OIIO::ustring path;
    OIIO::ImageCache *cache = nullptr;
};

// The parameter block of the signal.
struct Block {
    bl_sampled_grid grid;
    Pixels *pixels; // owned; released by image_release
};

// Called from C, which no exception may pass.
extern "C" void image_span(const void *source, const size_t index[BL_AXES], size_t count,
                           float *out) try {
    static_cast<const Pixels *>(source)->span(index[0], index[1], count, out);
} catch (...) {
    for (size_t i = 0; i < count; i++)
        out[i] = NAN;
}

extern "C" void image_row(const void *parameters, const double start[BL_AXES],
                          const double step[BL_AXES], size_t count, float *out) {
    bl_sampled_grid_row(&static_cast<const Block *>(parameters)->grid, start, step, count, out);
}

extern "C" double image_value(const void *parameters, const double at[BL_AXES]) {
    return bl_sampled_grid_value(&static_cast<const Block *>(parameters)->grid, at);
}

extern "C" void image_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                             float *out) {
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = static_cast<float>(image_value(parameters, place));
    }
}

extern "C" void image_release(void *parameters) {
    delete static_cast<Block *>(parameters)->pixels;
}

// By name, so that an ability more in the contract moves none of these.
bl_signal_functions functions_of_images() {
    bl_signal_functions functions{};
    functions.row = image_row;
    functions.points = image_points;
    functions.value = image_value;
    functions.release = image_release;
    return functions;
}

const bl_signal_functions image_functions = functions_of_images();

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
bl_status seek_part(OIIO::ImageInput &input, const bl_image_source &source, int &part,
                    bl_message *message) {
    int parts = 1;
    while (input.seek_subimage(parts, 0))
        parts++;
    (void)input.geterror();
    part = source.part < 0 ? 0 : source.part;
    if (source.part < 0 && parts > 1)
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %d parts; choose one with part=0 to part=%d", source.path, parts,
                         parts - 1);
    if (part >= parts)
        return bl_report(message, BL_USAGE, "part=%d of '%s': the file has %d part%s, from 0", part,
                         source.path, parts, parts == 1 ? "" : "s");
    if (!input.seek_subimage(part, 0))
        return report_reading(source.path, input.geterror(), message);
    return BL_OK;
}

bl_status find_channel(const OIIO::ImageSpec &spec, const bl_image_source &source, int &channel,
                       bl_message *message) {
    channel = 0;
    if (!source.channel)
        return BL_OK;
    channel = spec.channelindex(source.channel);
    unsigned long long index;
    if (channel < 0 && bl_read_unsigned(source.channel, &index) &&
        index < static_cast<unsigned long long>(spec.nchannels))
        channel = static_cast<int>(index);
    if (channel >= 0)
        return BL_OK;
    std::string names;
    for (int i = 0; i < spec.nchannels; i++)
        names += (i ? ", " : "") + std::string(spec.channel_name(i));
    return bl_report(message, BL_USAGE, "no channel '%s' in '%s'; it has %s (or 0 to %d)",
                     source.channel, source.path, names.c_str(), spec.nchannels - 1);
}

bl_status find_spacing(const OIIO::ImageSpec &spec, const bl_image_source &source, double &spacing,
                       bl_message *message) {
    spacing = source.spacing;
    if (spacing > 0)
        return BL_OK;
    const std::string text = find_attribute(spec, spacing_name, "1");
    if (bl_read_real(text.c_str(), &spacing) && spacing > 0)
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "'%s' says bandlimit:spacing is '%s', which is no size of a pixel; give "
                     "spacing=REAL",
                     source.path, text.c_str());
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

// Rows y to end - 1 of one channel. Scanlines are read one by one: the library's way of reading
// several at once does not notice when a TIFF ends early (OpenImageIO pull request 5336).
bool read_rows(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, int part, int channel, int y,
               int end, float *out) {
    const OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT;
    if (spec.tile_width)
        return input.read_tiles(part, 0, spec.x, spec.x + spec.width, y, end, spec.z, spec.z + 1,
                                channel, channel + 1, type, out);
    for (int line = y; line < end; line++, out += spec.width)
        if (!input.read_scanlines(part, 0, line, line + 1, spec.z, channel, channel + 1, type, out))
            return false;
    return true;
}

// Reads all rows once in strips, which finds a damaged file now, and keeps them if asked to.
bl_status read_all(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, int part, int channel,
                   bool keep, const char *path, Pixels &pixels, bl_message *message) {
    const int lines = spec.tile_width ? spec.tile_height : 64;
    std::vector<float> strip(pixels.width * static_cast<size_t>(lines));
    if (keep)
        pixels.held.resize(pixels.width * pixels.height);
    for (int y = spec.y; y < spec.y + spec.height; y += lines) {
        const int end = std::min(y + lines, spec.y + spec.height);
        if (!read_rows(input, spec, part, channel, y, end, strip.data()))
            return report_reading(path, input.geterror(), message);
        if (keep)
            std::copy_n(strip.data(), pixels.width * static_cast<size_t>(end - y),
                        &pixels.held[static_cast<size_t>(y - spec.y) * pixels.width]);
    }
    return BL_OK;
}

bl_status make_signal(const bl_image_source &source, double spacing, std::unique_ptr<Pixels> pixels,
                      bl_signal **out, bl_message *message) {
    Block block = {};
    block.pixels = pixels.get();
    block.grid.dims = 2;
    block.grid.size[0] = pixels->width;
    block.grid.size[1] = pixels->height;
    block.grid.size[2] = block.grid.size[3] = 1;
    block.grid.spacing = spacing;
    block.grid.wrap = source.wrap;
    block.grid.reading = source.reading;
    block.grid.span = image_span;
    block.grid.source = pixels.get();
    bl_signal *signal = bl_signal_new(&image_functions, &block, sizeof block, source.text);
    if (!signal)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", source.path);
    signal->name = "image";
    bl_sampled_grid_describe(&block.grid, signal);
    (void)pixels.release(); // the signal owns it now
    *out = signal;
    return BL_OK;
}

bl_status open_image(const bl_image_source &source, bl_signal **out, bl_message *message) {
    bl_status status = check_file(source.path, message);
    if (status != BL_OK)
        return status;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // values as stored, not times alpha
    auto input = OIIO::ImageInput::open(source.path, &hints);
    if (!input)
        return report_reading(source.path, OIIO::geterror(), message);
    int part, channel;
    double spacing;
    if ((status = seek_part(*input, source, part, message)) != BL_OK)
        return status;
    const OIIO::ImageSpec spec = input->spec();
    if ((status = check_shape(spec, source.path, message)) != BL_OK ||
        (status = find_channel(spec, source, channel, message)) != BL_OK ||
        (status = find_spacing(spec, source, spacing, message)) != BL_OK)
        return status;
    auto pixels = std::make_unique<Pixels>(spec, source.path, part, channel);
    const double bytes = 4.0 * spec.width * spec.height;
    const bool keep = bytes <= static_cast<double>(source.memory_bytes);
    status = read_all(*input, spec, part, channel, keep, source.path, *pixels, message);
    if (status != BL_OK)
        return status;
    if (!keep)
        pixels->use_cache(source.memory_bytes);
    return make_signal(source, spacing, std::move(pixels), out, message);
}

// --- pictures for textures ----------------------------------------------------------------------

// Linear colours in memory, row 0 at the top.
struct Picture {
    size_t width = 0, height = 0;
    std::vector<float> rgb;
    double mean[3] = {0, 0, 0}, least[3], most[3];
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

bl_status read_picture(const char *path, Picture &picture, bl_message *message) {
    bl_status status = check_file(path, message);
    if (status != BL_OK)
        return status;
    auto input = OIIO::ImageInput::open(path);
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
    const bool encoded = spec.get_string_attribute("oiio:ColorSpace") == "sRGB";
    picture.width = width;
    picture.height = height;
    picture.rgb.resize(3 * width * height);
    for (size_t i = 0; i < picture.rgb.size(); i++) {
        const double code = read[channels == 3 ? i : i / 3];
        picture.rgb[i] = static_cast<float>(encoded ? decode_srgb(code) : code);
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

bl_status open_texels(const char *path, bl_texels **out, bl_message *message) {
    auto texels = std::make_unique<bl_texels>();
    if (*path) {
        bl_status status = read_picture(path, texels->picture, message);
        if (status != BL_OK)
            return status;
    } else {
        draw_card(texels->picture);
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
    const float up = static_cast<float>(std::fmin(width_t, 1e6));
    float result[3] = {NAN, NAN, NAN};
    const std::lock_guard<std::mutex> guard(texels.turn);
    if (!texels.system->texture(texels.handle, texels.state, options, fraction_of(s),
                                fraction_of(-t), across, 0.0f, 0.0f, up, 3, result))
        (void)texels.system->geterror();
    for (int c = 0; c < 3; c++)
        rgb[c] = static_cast<double>(result[c]);
}

bl_status report_thrown(const char *path, const char *what, bl_message *message) {
    return bl_report(message, BL_DEVICE, "'%s': the image library failed: %s", path, what);
}

} // namespace

extern "C" bl_status bl_image_write(const char *path, const bl_image *image,
                                    bl_message *message) try {
    return write_image(path, *image, message);
} catch (const std::exception &thrown) {
    return report_thrown(path, thrown.what(), message);
} catch (...) {
    return report_thrown(path, "no reason given", message);
}

extern "C" bl_status bl_image_open(const bl_image_source *source, bl_signal **signal,
                                   bl_message *message) try {
    return open_image(*source, signal, message);
} catch (const std::exception &thrown) {
    return report_thrown(source->path, thrown.what(), message);
} catch (...) {
    return report_thrown(source->path, "no reason given", message);
}

extern "C" bl_status bl_texels_open(const char *path, bl_texels **texels, bl_message *message) try {
    return open_texels(path, texels, message);
} catch (const std::exception &thrown) {
    return report_thrown(path, thrown.what(), message);
} catch (...) {
    return report_thrown(path, "no reason given", message);
}

extern "C" void bl_texels_close(bl_texels *texels) {
    delete texels;
}

extern "C" void bl_texels_look(const bl_texels *texels, double s, double t, double width_s,
                               double width_t, bl_texels_reading reading, double rgb[3]) try {
    rgb[0] = rgb[1] = rgb[2] = NAN;
    if (std::isfinite(s) && std::isfinite(t) && width_s >= 0 && width_t >= 0)
        look(*texels, s, t, width_s, width_t, reading, rgb);
} catch (...) {
    rgb[0] = rgb[1] = rgb[2] = NAN;
}

extern "C" void bl_texels_mean(const bl_texels *texels, double rgb[3]) {
    std::copy_n(texels->picture.mean, 3, rgb);
}

extern "C" void bl_texels_bounds(const bl_texels *texels, double least[3], double most[3]) {
    std::copy_n(texels->picture.least, 3, least);
    std::copy_n(texels->picture.most, 3, most);
}

extern "C" void bl_texels_size(const bl_texels *texels, size_t size[2]) {
    size[0] = texels->picture.width;
    size[1] = texels->picture.height;
}

extern "C" void bl_texels_plane(const bl_texels *texels, int component, float *out) {
    const std::vector<float> &rgb = texels->picture.rgb;
    for (size_t i = static_cast<size_t>(component); i < rgb.size(); i += 3)
        *out++ = rgb[i];
}
