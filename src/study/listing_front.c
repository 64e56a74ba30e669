/* study/listing_front.c - what a batch folder says of its front. */
#include "study/listing_changes.h"

ambulo_status ambulo__listing_front_text(const ambulo_sweep *s, ambulo__text_buffer *text) {
  for (int i = 0; i < s->front.terms; i++) {
    ambulo__text_append_format(text, "%s%s ", i ? ", " : "", s->front.name[i]);
    ambulo__text_append_number(text, s->front.own[i]);
  }
  ambulo__text_append_format(text, "; %d points, least ", s->front.points);
  ambulo__text_append_number(text, s->front.least);
  ambulo__text_append(text, s->front.neighbour ? ", from neighbours" : ", from zero");
  return ambulo__text_status(text);
}

void ambulo__listing_describe_front(const ambulo_sweep *s, ambulo__json *json) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, json->text);
  (void)ambulo__listing_front_text(s, &text);
  ambulo__json_open(json, "front", '{');
  ambulo__json_text(json, "text", ambulo__text_data(&text));
  ambulo__json_open(json, "terms", '[');
  for (int i = 0; i < s->front.terms; i++) ambulo__json_text(json, NULL, s->front.name[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "weights", '[');
  for (int i = 0; i < s->front.terms; i++) ambulo__json_number(json, NULL, s->front.own[i]);
  ambulo__json_close(json, ']');
  ambulo__json_integer(json, "points", s->front.points);
  ambulo__json_number(json, "least", s->front.least);
  ambulo__json_close(json, '}');
  ambulo__text_free(&text);
}
