// The one C++ file: OpenImageIO behind the C interface of image/oiio.h.
#include "image/oiio.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

struct image_oiio_reader {
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    std::string view, command, software;
    std::unique_ptr<float[]> pixels; // not touched before data comes
};

namespace {

void say(char *message, std::size_t size, const std::string &text) {
    // The library ends some texts with newlines.
    std::string trimmed = text.substr(0, text.find_last_not_of(" \n") + 1);
    std::snprintf(message, size, "%s", trimmed.empty() ? "OpenImageIO gives no reason" : trimmed.c_str());
}

// Runs `work` and turns whatever it throws into a message.
template <typename Result, typename Work> Result guarded(Result failure, char *message, std::size_t size, Work work) {
    try {
        return work();
    } catch (const std::exception &e) {
        say(message, size, e.what());
    } catch (...) {
        say(message, size, "an unknown exception");
    }
    return failure;
}

// A file that remembers a failing write: several of OpenImageIO's formats let them pass unnoticed. It gathers what is
// written in a row, for some formats come byte by byte.
class checked_file final : public OIIO::Filesystem::IOProxy {
  public:
    explicit checked_file(const char *path) : IOProxy(path, Write) {}
    checked_file(const checked_file &) = delete;
    checked_file &operator=(const checked_file &) = delete;
    ~checked_file() override {
        if (descriptor >= 0)
            ::close(descriptor);
    }

    bool create() {
        descriptor = ::open(m_filename.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor < 0)
            error = errno;
        gathered.reserve(room);
        return descriptor >= 0;
    }
    const char *proxytype() const override { return "graze"; }
    std::size_t read(void *buffer, std::size_t count) override {
        std::size_t done = pread(buffer, count, m_pos);
        m_pos += static_cast<std::int64_t>(done);
        return done;
    }
    std::size_t write(const void *buffer, std::size_t count) override {
        std::size_t done = pwrite(buffer, count, m_pos);
        m_pos += static_cast<std::int64_t>(done);
        return done;
    }
    std::size_t pread(void *buffer, std::size_t count, std::int64_t offset) override {
        ssize_t done = write_gathered() ? ::pread(descriptor, buffer, count, offset) : -1;
        return done > 0 ? static_cast<std::size_t>(done) : 0;
    }
    std::size_t pwrite(const void *buffer, std::size_t count, std::int64_t offset) override {
        if ((offset != gathered_end() || gathered.size() + count > room) && !write_gathered())
            return 0;
        const char *bytes = static_cast<const char *>(buffer);
        if (count > room)
            return write_out(bytes, count, offset);
        if (gathered.empty())
            gathered_begin = offset;
        gathered.insert(gathered.end(), bytes, bytes + count);
        return count;
    }
    std::size_t size() const override {
        struct stat status;
        std::int64_t written = fstat(descriptor, &status) == 0 ? status.st_size : 0;
        return static_cast<std::size_t>(gathered.empty() ? written : std::max(written, gathered_end()));
    }

    // errno of the first trouble, the closing's included; 0 for none.
    int finish() {
        write_gathered();
        int closed = descriptor >= 0 ? ::close(descriptor) : 0;
        descriptor = -1;
        return error ? error : closed != 0 ? errno : 0;
    }

  private:
    static constexpr std::size_t room = 1 << 16;
    int descriptor = -1;
    int error = 0;
    std::vector<char> gathered;
    std::int64_t gathered_begin = 0;

    std::int64_t gathered_end() const { return gathered_begin + static_cast<std::int64_t>(gathered.size()); }
    std::size_t write_out(const char *bytes, std::size_t count, std::int64_t offset) {
        std::size_t done = 0;
        while (done < count) {
            ssize_t now = ::pwrite(descriptor, bytes + done, count - done, offset + static_cast<std::int64_t>(done));
            if (now < 0 && errno == EINTR)
                continue;
            if (now <= 0) {
                error = now < 0 ? errno : ENOSPC;
                break;
            }
            done += static_cast<std::size_t>(now);
        }
        return done;
    }
    bool write_gathered() {
        if (error == 0 && !gathered.empty())
            write_out(gathered.data(), gathered.size(), gathered_begin);
        gathered.clear();
        return error == 0;
    }
};

// Formats that keep nothing of a picture or no colours, that cannot be kept from writing the date, and those that Graze
// writes itself, as floats. OpenImageIO 2.4 crashes in writing a large GIF, and cuts one with a side above 65535.
bool is_picture_format(const std::string &name) {
    return name != "null" && name != "term" && name != "zfile" && name != "rla" && name != "hdr" && name != "openexr" &&
           name != "gif";
}

int can_write(const char *suffix) {
    char ignored[1];
    return guarded(0, ignored, sizeof ignored, [&] {
        auto output = OIIO::ImageOutput::create(std::string("picture.") + suffix);
        if (!output)
            OIIO::geterror(); // or it would be printed at exit
        return output && is_picture_format(output->format_name()) ? 1 : 0;
    });
}

// What the formats hold, or their libraries write. libjpeg ends the process beyond that, libpng and libwebp give no
// reason.
int longest_side(const char *suffix) {
    static const std::pair<const char *, int> limits[] = {{"ico", 256},     {"iff", 8192},  {"jpeg", 65500},
                                                          {"png", 1000000}, {"sgi", 65534}, {"targa", 65535},
                                                          {"webp", 16383}};
    char ignored[1];
    return guarded(INT_MAX, ignored, sizeof ignored, [&] {
        auto output = OIIO::ImageOutput::create(std::string("picture.") + suffix);
        if (!output)
            OIIO::geterror();
        for (const auto &[name, limit] : limits)
            if (output && std::strcmp(output->format_name(), name) == 0)
                return limit;
        return INT_MAX;
    });
}

void list_writable(char *text, std::size_t size) {
    guarded(0, text, size, [&] {
        std::string list;
        for (const auto &[format, suffixes] : OIIO::get_extension_map())
            for (const std::string &suffix : suffixes)
                if (can_write(suffix.c_str()))
                    list += (list.empty() ? "." : ", .") + suffix;
        std::snprintf(text, size, "%s", list.c_str());
        return 1;
    });
}

// Nothing that differs from run to run goes into a file: a date would, so it is unknown, in Exif's spelling.
OIIO::ImageSpec describe(int width, int height, const image_oiio_header *header) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("DateTime", "    :  :     :  :  ");
    spec.attribute("PixelAspectRatio", static_cast<float>(1 / header->pixel_aspect));
    if (header->software)
        spec.attribute("Software", header->software);
    if (header->command)
        spec.attribute("ImageDescription", header->command);
    return spec;
}

// Whether the file holds a picture of this size, down to its last pixel.
bool is_complete(const char *file, int width, int height) {
    auto input = OIIO::ImageInput::open(file);
    if (!input) {
        OIIO::geterror();
        return false;
    }
    const OIIO::ImageSpec &spec = input->spec();
    std::vector<unsigned char> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    return spec.width == width && spec.height == height &&
           input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data());
}

// OpenImageIO 2.4 loses a TIFF's directory when it writes through a proxy.
bool has_sound_proxy(const OIIO::ImageOutput &output) {
    return output.supports("ioproxy") && std::strcmp(output.format_name(), "tiff") != 0;
}

// What is wrong, in the library's words, which know the file by another name than the user does.
std::string reason_of(const OIIO::ImageOutput &output, const std::string &file, const char *name) {
    std::string text = output.geterror();
    for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file, at + std::strlen(name)))
        text.replace(at, file.size(), name);
    return text.empty() ? "OpenImageIO gives no reason" : text;
}

// Empty for success.
std::string write_by_name(OIIO::ImageOutput &output, const char *file, const char *name, const OIIO::ImageSpec &spec,
                          const unsigned char *pixels) {
    bool written = output.open(file, spec) && output.write_image(OIIO::TypeDesc::UINT8, pixels) && output.close();
    return written ? "" : reason_of(output, file, name);
}

std::string write_checked(OIIO::ImageOutput &output, checked_file &file, const char *name, const OIIO::ImageSpec &spec,
                          const unsigned char *pixels) {
    bool written = file.create() && output.set_ioproxy(&file) && output.open(file.filename(), spec) &&
                   output.write_image(OIIO::TypeDesc::UINT8, pixels) && output.close();
    int error = file.finish();
    if (error)
        return std::generic_category().message(error);
    return written ? "" : reason_of(output, file.filename(), name);
}

// Formats that can only write to a file of their own opening let failing writes pass, and some cut what they cannot
// hold: every file is read again.
int write(const char *file, const char *name, int width, int height, const unsigned char *rgb,
          const image_oiio_header *header, char *message, std::size_t message_size) {
    return guarded(0, message, message_size, [&] {
        checked_file checked(file); // outlives `output`, which may turn to it until its very end
        auto output = OIIO::ImageOutput::create(file);
        if (!output) {
            say(message, message_size, OIIO::geterror());
            return 0;
        }
        OIIO::ImageSpec spec = describe(width, height, header);
        std::string trouble = has_sound_proxy(*output) ? write_checked(*output, checked, name, spec, rgb)
                                                       : write_by_name(*output, file, name, spec, rgb);
        if (trouble.empty() && !is_complete(file, width, height))
            trouble = "the file came out incomplete";
        if (!trouble.empty())
            say(message, message_size, trouble);
        return trouble.empty() ? 1 : 0;
    });
}

image_oiio_reader *open(const char *file, int *width, int *height, int *channels, char *message,
                        std::size_t message_size) {
    return guarded(static_cast<image_oiio_reader *>(nullptr), message, message_size, [&]() -> image_oiio_reader * {
        auto reader = std::make_unique<image_oiio_reader>();
        reader->input = OIIO::ImageInput::open(file);
        if (!reader->input) {
            say(message, message_size, OIIO::geterror());
            return nullptr;
        }
        const OIIO::ImageSpec &spec = reader->spec = reader->input->spec();
        if (spec.deep || spec.depth > 1) {
            say(message, message_size, "deep and volume pictures cannot be read");
            return nullptr;
        }
        reader->view = spec.get_string_attribute("radianceView");
        reader->command = spec.get_string_attribute("command", spec.get_string_attribute("ImageDescription"));
        reader->software = spec.get_string_attribute("Software");
        *width = spec.width;
        *height = spec.height;
        *channels = spec.nchannels;
        return reader.release();
    });
}

const char *channel_name(const image_oiio_reader *reader, int channel) {
    const auto &names = reader->spec.channelnames;
    return static_cast<std::size_t>(channel) < names.size() ? names[channel].c_str() : "";
}

// What says nothing of itself is sRGB where it has 8 bits a channel; netpbm's Rec709 is taken as the same.
int is_srgb(const image_oiio_reader *reader) {
    char ignored[1];
    return guarded(0, ignored, sizeof ignored, [&] {
        bool is_byte = reader->spec.format.basetype == OIIO::TypeDesc::UINT8;
        std::string space = reader->spec.get_string_attribute("oiio:ColorSpace");
        return space == "sRGB" || space == "Rec709" || (space.empty() && is_byte) ? 1 : 0;
    });
}

image_oiio_header header(const image_oiio_reader *reader) {
    char ignored[1];
    image_oiio_header result = {1, nullptr, nullptr, nullptr};
    return guarded(result, ignored, sizeof ignored, [&] {
        double aspect = reader->spec.get_float_attribute("PixelAspectRatio", 1);
        result.pixel_aspect = aspect > 1e-3 && aspect < 1e3 ? 1 / aspect : 1;
        result.view = reader->view.empty() ? nullptr : reader->view.c_str();
        result.command = reader->command.empty() ? nullptr : reader->command.c_str();
        result.software = reader->software.empty() ? nullptr : reader->software.c_str();
        return result;
    });
}

const float *read(image_oiio_reader *reader, char *message, std::size_t message_size) {
    return guarded(static_cast<const float *>(nullptr), message, message_size, [&]() -> const float * {
        const OIIO::ImageSpec &spec = reader->spec;
        reader->pixels.reset(new float[spec.image_pixels() * static_cast<std::size_t>(spec.nchannels)]);
        if (!reader->input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, reader->pixels.get())) {
            say(message, message_size, reader->input->geterror());
            return nullptr;
        }
        return reader->pixels.get();
    });
}

void close(image_oiio_reader *reader) {
    char ignored[1];
    guarded(0, ignored, sizeof ignored, [&] {
        delete reader;
        return 1;
    });
}

const image_oiio interface = {can_write,    longest_side, list_writable, write, open,
                              channel_name, is_srgb,      header,        read,  close};

} // namespace

extern "C" __attribute__((visibility("default"))) const image_oiio *graze_oiio(void) {
    return &interface;
}
