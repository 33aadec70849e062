/* Checkpoints and previews: of pictures stopped at any moment, and of files that are not what they should be. */
#include "picture/support.h"

#include <pthread.h>
#include <sched.h>

#include "picture/checkpoint.h"

static const checkpoint_labels labels = {"samples 64\nscene 1\n", "gpict -o x.hdr room.rad"};

static graze_trace_settings slow(void) {
    graze_trace_settings trace = graze_trace_defaults();
    trace.error = 0.02;
    return trace;
}

static void *render(void *picture) {
    assert_int_equal(picture_render(picture, NULL), GRAZE_OK);
    return NULL;
}

/* Renders in another thread until so many pixels are finished, at least; writes a checkpoint while it goes on. */
static void write_under_way(sitting *s, size_t finished, const char *file) {
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, render, s->picture), 0);
    while (picture_look(s->picture).finished < finished)
        sched_yield();
    assert_int_equal(checkpoint_write(s->picture, file, &labels, NULL), GRAZE_OK);
    picture_stop(s->picture);
    pthread_join(thread, NULL);
}

/* A name for a file that is not there. */
static written_file new_file(void) {
    written_file file = written_file_make("", 0);
    unlink(file.name);
    return file;
}

static void check_going_on(const char *text, graze_trace_settings trace, picture_settings s) {
    sitting whole = sitting_of(text, &trace, &s);
    size_t pixels = (size_t)s.width * (size_t)s.height;
    const size_t moments[] = {0, 1, pixels / 12, pixels / 2, pixels};
    for (size_t i = 0; i < sizeof moments / sizeof *moments; i++) {
        written_file file = new_file();
        sitting first = sitting_begin(text, &trace, &s);
        write_under_way(&first, moments[i], file.name);
        checkpoint *read;
        messages[0] = 0;
        assert_int_equal(checkpoint_read(&read, file.name, &remembering), GRAZE_OK);
        assert_string_equal(checkpoint_command(read), labels.command);
        picture_settings begun = {.threads = 3, .jitter = 1, .spacing = 8, .content = PICTURE_LAYERS};
        checkpoint_settings(read, &begun);
        sitting second = sitting_begin(text, &trace, &begun);
        assert_int_equal(checkpoint_resume(read, second.picture, labels.question, &remembering), GRAZE_OK);
        assert_true(picture_look(second.picture).finished >= moments[i]);
        checkpoint_destroy(read);
        assert_int_equal(picture_render(second.picture, NULL), GRAZE_OK);
        assert_same_pictures(&whole, &second);
        picture_progress a = picture_look(whole.picture), b = picture_look(second.picture);
        assert_int_equal(b.finished, b.total);
        assert_int_equal(a.unconverged, b.unconverged);
        assert_true(fabs(a.error - b.error) < 1e-6);
        checkpoint_remove(file.name);
        assert_int_equal(access(file.name, F_OK), -1);
        sitting_end(&first);
        sitting_end(&second);
    }
    sitting_end(&whole);
}

static void a_picture_goes_on_to_the_same_bytes(void **state) {
    (void)state;
    check_going_on(room, slow(), room_settings());
}

/* What was found out before the first pixel is found out again: a picture large enough for an irradiance cache. */
static void a_picture_of_interreflections_goes_on_to_the_same_bytes(void **state) {
    (void)state;
    static const char box[] = "void plastic p 0 0 5 .5 .5 .5 0 0 p bubble walls 0 0 4 0 0 0 6\n"
                              "void light l 0 0 3 9 9 9 l sphere lamp 0 0 4 0 3 1 .3\n";
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    trace.error = 0.2;
    trace.ambient_bounces = 2;
    s.width = 64;
    s.height = 48;
    check_going_on(box, trace, s);
}

/* Views' bits survive, where printing them would not. */
static void the_view_is_the_same_to_the_last_bit(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings(), again = s;
    s.view.point.x = 1.0 / 3;
    s.view.up = (vec3){0.1, 0.2, 0.7};
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    sitting begun = sitting_begin(room, &trace, &s);
    written_file file = new_file();
    assert_int_equal(checkpoint_write(begun.picture, file.name, &labels, NULL), GRAZE_OK);
    checkpoint *read;
    assert_int_equal(checkpoint_read(&read, file.name, NULL), GRAZE_OK);
    checkpoint_settings(read, &again);
    assert_memory_equal(&again.view.point, &s.view.point, sizeof s.view - offsetof(rad_view, point));
    assert_int_equal(again.view.type, s.view.type);
    checkpoint_destroy(read);
    checkpoint_remove(file.name);
    sitting_end(&begun);
}

static void assert_refused(const char *file, const picture_settings *s, const char *question, const char *why) {
    graze_trace_settings trace = slow();
    checkpoint *read;
    sitting other = sitting_begin(room, &trace, s);
    messages[0] = 0;
    graze_status status = checkpoint_read(&read, file, &remembering);
    if (status == GRAZE_OK)
        status = checkpoint_resume(read, other.picture, question, &remembering);
    assert_int_equal(status, GRAZE_INPUT_ERROR);
    if (!strstr(messages, why))
        fail_msg("'%s' does not say '%s'", messages, why);
    checkpoint_destroy(read);
    sitting_end(&other);
}

static void other_questions_are_refused(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    s.content = PICTURE_DEPTH;
    sitting begun = sitting_begin(room, &trace, &s);
    written_file file = new_file();
    assert_int_equal(checkpoint_write(begun.picture, file.name, &labels, NULL), GRAZE_OK);
    assert_refused(file.name, &s, "samples 64\nscene 2\n", "begun with another scene");
    assert_refused(file.name, &s, "samples 64\n", "begun with 'scene 1' and cannot go on with ''");
    assert_refused(file.name, &s, "samples 64\nscene 1\nmore\n", "begun with '' and cannot go on with 'more'");
    s.content = PICTURE_LAYERS;
    assert_refused(file.name, &s, labels.question, "without the layers");
    s.content = PICTURE_COLOR;
    s.width--;
    assert_refused(file.name, &s, labels.question, "another size");
    checkpoint_remove(file.name);
    assert_refused(file.name, &s, labels.question, "No such file");
    sitting_end(&begun);
}

/* Every byte counts: cut off or changed anywhere, the file is refused. */
static void damaged_files_are_refused(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    s.width = s.height = 3;
    sitting begun = sitting_of(room, &trace, &s);
    written_file file = new_file();
    assert_int_equal(checkpoint_write(begun.picture, file.name, &labels, NULL), GRAZE_OK);
    unsigned char bytes[8192];
    FILE *in = fopen(file.name, "rb");
    assert_non_null(in);
    size_t length = fread(bytes, 1, sizeof bytes, in);
    fclose(in);
    assert_true(length > 500 && length < sizeof bytes);
    for (size_t i = 0; i < length; i++) {
        written_file cut = written_file_make(bytes, i);
        bytes[i] ^= 0x40;
        written_file changed = written_file_make(bytes, length);
        bytes[i] ^= 0x40;
        checkpoint *read;
        assert_int_equal(checkpoint_read(&read, cut.name, NULL), GRAZE_INPUT_ERROR);
        assert_null(read);
        assert_int_equal(checkpoint_read(&read, changed.name, NULL), GRAZE_INPUT_ERROR);
        assert_null(read);
        unlink(cut.name);
        unlink(changed.name);
    }
    assert_true(checkpoint_is(file.name));
    checkpoint_remove(file.name);
    assert_false(checkpoint_is(file.name));
    sitting_end(&begun);
}

/* Nothing half-written, and what was there before stays. */
static void a_checkpoint_that_cannot_be_written_is_told(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    sitting begun = sitting_begin(room, &trace, &s);
    messages[0] = 0;
    assert_int_equal(checkpoint_write(begun.picture, "/nowhere/x.checkpoint", &labels, &remembering),
                     GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, "/nowhere/x.checkpoint"));
    sitting_end(&begun);
}

/* ---- Previews ---- */

static void a_preview_of_all_is_the_picture(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    sitting whole = sitting_of(room, &trace, &s);
    image *preview;
    assert_int_equal(picture_preview(whole.picture, &preview, NULL), GRAZE_OK);
    assert_int_equal(preview->channel_count, 3);
    for (int c = 0; c < 3; c++)
        assert_memory_equal(preview->channels[c], picture_image(whole.picture)->channels[c], PIXELS * sizeof(float));
    image_destroy(preview);
    sitting_end(&whole);
}

/* Half-way, finished pixels are themselves and the others within what is finished. */
static void a_preview_is_filled_in(void **state) {
    (void)state;
    graze_trace_settings trace = slow();
    picture_settings s = room_settings();
    sitting half = sitting_begin(room, &trace, &s);
    written_file file = new_file();
    image *preview;
    assert_int_equal(picture_preview(half.picture, &preview, NULL), GRAZE_OK);
    for (int i = 0; i < PIXELS; i++)
        assert_true(preview->channels[0][i] == 0);
    image_destroy(preview);
    write_under_way(&half, PIXELS / 3, file.name);
    const float *now = plane(&half, "R");
    float most = 0;
    for (int i = 0; i < PIXELS; i++)
        most = fmaxf(most, now[i]);
    assert_int_equal(picture_preview(half.picture, &preview, NULL), GRAZE_OK);
    int filled = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_true(preview->channels[0][i] >= 0 && preview->channels[0][i] <= most);
        if (now[i] > 0)
            assert_true(preview->channels[0][i] == now[i]);
        else
            filled += preview->channels[0][i] > 0;
    }
    assert_true(filled > 0 || picture_look(half.picture).finished == PIXELS);
    image_destroy(preview);
    checkpoint_remove(file.name);
    sitting_end(&half);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_goes_on_to_the_same_bytes),
        cmocka_unit_test(a_picture_of_interreflections_goes_on_to_the_same_bytes),
        cmocka_unit_test(the_view_is_the_same_to_the_last_bit),
        cmocka_unit_test(other_questions_are_refused),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(a_checkpoint_that_cannot_be_written_is_told),
        cmocka_unit_test(a_preview_of_all_is_the_picture),
        cmocka_unit_test(a_preview_is_filled_in),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
