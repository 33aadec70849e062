/* Colours of levels. */
#include "image/levels.h"

bool image_level_color(const image_levels *l, int level, unsigned char color[3]) {
    if (level < l->first || level - l->first >= l->count || level == l->without)
        return false;
    image_palette_color(l->palette, (double)level / l->scale->divisions, color);
    return true;
}
