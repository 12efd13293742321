// SPDX-License-Identifier: MIT
//
// Chapter 8: figures; chapter 9: images.
#include "api/api.h"

#include <stdlib.h>

#include "core/grammar.h"
#include "core/image.h"
#include "reports/figure.h"
#include "reports/reproduce.h"

// --- figures ---

bandlimit_status bandlimit_reproduce(const char *const *names, size_t count,
                                     const bandlimit_reproduce_settings *settings,
                                     bandlimit_reproduction *reproduction,
                                     bandlimit_message *message) {
    bandlimit_reproduce_settings own;
    bl_status status = BL_API_CHECK(reproduction, bandlimit_reproduction, message);
    if (status == BL_OK)
        status = BL_API_TAKE(settings, &own, bandlimit_reproduce_settings, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_reproduce_settings used = bl_reproduce_default_settings();
    if (own.folder)
        used.folder = own.folder;
    used.format = own.pdf ? "pdf" : "svg";
    used.size = bl_api_size(own.effort);
    used.seed = BL_API_SEED(own);
    used.threads = own.threads;
    used.progress = own.progress;
    used.user = own.user;
    bl_reproduction *room = bl_api_room(sizeof *room, message);
    status = room ? bl_reproduce(names, count, &used, room, bl_api_message(message)) : BL_DEVICE;
    if (status != BL_OK)
        return bl_api_end(status, NULL, room, message);
    *reproduction = (bandlimit_reproduction){.bytes = sizeof *reproduction,
                                             .verdict = (bandlimit_verdict)room->verdict,
                                             .page = room->page,
                                             .seconds = room->seconds,
                                             .owned = room};
    for (size_t f = 0; f < room->count; f++)
        reproduction->count += room->figures[f].claim_count;
    return BANDLIMIT_OK;
}

bandlimit_status bandlimit_figure_claim_at(const bandlimit_reproduction *reproduction, size_t index,
                                           bandlimit_figure_claim *claim,
                                           bandlimit_message *message) {
    const bl_reproduction *room = reproduction->owned;
    bl_status status = BL_API_CHECK(claim, bandlimit_figure_claim, message);
    if (status == BL_OK)
        status = bl_api_index(index, reproduction->count, "claim", message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_figure_result *figure = room->figures;
    for (; index >= figure->claim_count; figure++)
        index -= figure->claim_count;
    const bl_claim *own = &figure->claims[index];
    *claim = (bandlimit_figure_claim){.bytes = sizeof *claim,
                                      .figure = figure->figure->name,
                                      .sentence = own->sentence,
                                      .source = own->source,
                                      .unit = own->unit,
                                      .expected_lower = own->expected_lower,
                                      .expected_upper = own->expected_upper,
                                      .measured = bl_api_estimate(&own->measured),
                                      .verdict = (bandlimit_verdict)own->verdict};
    return BANDLIMIT_OK;
}

void bandlimit_reproduction_free(bandlimit_reproduction *reproduction) {
    BL_API_RELEASE(reproduction, bl_reproduction_free);
}

// --- images ---

bandlimit_status bandlimit_image_write(const char *path, const bandlimit_image *image,
                                       bandlimit_message *message) {
    bl_status status = BL_API_CHECK(image, bandlimit_image, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_image own = {.width = image->width,
                          .height = image->height,
                          .channels = image->channels,
                          .values = image->values,
                          .spacing = image->spacing,
                          .black = image->black,
                          .white = image->white,
                          .bits = image->bits,
                          .srgb = image->srgb};
    return (bandlimit_status)bl_image_write(path, &own, bl_api_message(message));
}

bandlimit_status bandlimit_image_read(const char *path, const char *channel, bandlimit_image *image,
                                      bandlimit_message *message) {
    bl_pixels *pixels;
    bl_pixels_facts facts;
    bl_status status = BL_API_CHECK(image, bandlimit_image, message);
    if (status == BL_OK)
        status = bl_pixels_open(&(bl_pixels_choice){.path = path,
                                                    .channel = channel,
                                                    .channel_index = bl_channel_index(channel),
                                                    .part = 0,
                                                    .memory_bytes = SIZE_MAX},
                                &pixels, &facts, bl_api_message(message));
    if (status != BL_OK)
        return (bandlimit_status)status;
    float *values = bl_api_room(facts.width * facts.height * sizeof *values, message);
    for (size_t y = 0; values && y < facts.height; y++)
        bl_pixels_span(pixels, 0, y, facts.width, values + y * facts.width);
    bl_pixels_close(pixels);
    if (!values)
        return BANDLIMIT_DEVICE;
    double spacing = 0;
    if (!bl_read_real(facts.spacing, &spacing) || !(spacing > 0))
        spacing = 0;
    *image = (bandlimit_image){.bytes = sizeof *image,
                               .width = facts.width,
                               .height = facts.height,
                               .channels = 1,
                               .values = values,
                               .spacing = spacing,
                               .owned = values};
    return BANDLIMIT_OK;
}

void bandlimit_image_free(bandlimit_image *image) {
    free(image->owned);
    BANDLIMIT_INIT(image);
}
