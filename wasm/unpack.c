// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks LZMA in a page, which browsers don't do by themselves: a module of its own, some 2 kB, without a C library. Range
// coder, contexts and matches as the format's public specification tells them ("LZMA specification", 7-Zip, 2015).
//
// A .lzma file: a byte of properties, 4 of the dictionary's size, 8 of the unpacked size, then the stream. The size has to
// be told (wasm/studio.mjs writes it).
#include <stdint.h>

/// Probabilities have so many bits, and move by a share of what is left.
enum { model_bits = 11, move_bits = 5 };

/// Of contexts for the length of a match: whether it is longer, short ones and middle ones by place, long ones.
enum { lengths_middle = 2 + (16 << 3), lengths_long = lengths_middle + (16 << 3), lengths_size = lengths_long + 256 };

static uint16_t is_match[12][16], is_repeated[12], is_repeat0[12], is_repeat1[12], is_repeat2[12], is_long_repeat[12][16];
static uint16_t slots[4][64], distances[128], alignment[16], match_lengths[lengths_size], repeat_lengths[lengths_size];
/// Up to 4 bits of the byte before and of the place together.
static uint16_t literals[0x300 << 4];

static const uint8_t* from;
static uint32_t range, code;

static void reset(uint16_t* contexts, uint32_t bytes) {
  for (uint32_t i = 0; i < bytes / sizeof(uint16_t); ++i) {
    contexts[i] = 1 << (model_bits - 1);
  }
}

static inline void refill(void) {
  if (range < 1U << 24) {
    range <<= 8;
    code = (code << 8) | *from++;
  }
}

static inline uint32_t bit(uint16_t* context) {
  const uint32_t probability = *context;
  const uint32_t bound = (range >> model_bits) * probability;
  uint32_t result;
  if (code < bound) {
    range = bound;
    *context = (uint16_t)(probability + (((1U << model_bits) - probability) >> move_bits));
    result = 0;
  } else {
    range -= bound;
    code -= bound;
    *context = (uint16_t)(probability - (probability >> move_bits));
    result = 1;
  }
  refill();
  return result;
}

static uint32_t number(uint16_t* tree, uint32_t bits) {
  uint32_t m = 1;
  for (uint32_t i = 0; i < bits; ++i) {
    m = (m << 1) | bit(tree + m);
  }
  return m - (1U << bits);
}

/// The lowest bit first.
static uint32_t reversed(uint16_t* tree, uint32_t bits) {
  uint32_t m = 1;
  uint32_t result = 0;
  for (uint32_t i = 0; i < bits; ++i) {
    const uint32_t b = bit(tree + m);
    m = (m << 1) | b;
    result |= b << i;
  }
  return result;
}

/// Bits that are as likely 0 as 1.
static uint32_t direct(uint32_t bits) {
  uint32_t result = 0;
  for (uint32_t i = 0; i < bits; ++i) {
    range >>= 1;
    const uint32_t above = code >= range;
    code -= above ? range : 0;
    refill();
    result = (result << 1) | above;
  }
  return result;
}

static uint32_t length(uint16_t* lengths, uint32_t place) {
  if (!bit(lengths)) {
    return 2 + number(lengths + 2 + (place << 3), 3);
  }
  if (!bit(lengths + 1)) {
    return 10 + number(lengths + lengths_middle + (place << 3), 3);
  }
  return 18 + number(lengths + lengths_long, 8);
}

/// Unpacks a .lzma file to `out`; the page has made room for it there.
__attribute__((export_name("unpack"))) void unpack(const uint8_t* packed, uint8_t* out) {
  const uint32_t literal_context = packed[0] % 9;
  const uint32_t literal_mask = (1U << (packed[0] / 9 % 5)) - 1;
  const uint32_t place_mask = (1U << (packed[0] / 45)) - 1;
  const uint32_t size = packed[5] | packed[6] << 8 | packed[7] << 16 | (uint32_t)packed[8] << 24;
  from = packed + 14;
  range = 0xffffffff;
  code = 0;
  for (int i = 0; i < 4; ++i) {
    code = (code << 8) | *from++;
  }
  reset(is_match[0], sizeof is_match);
  reset(is_repeated, sizeof is_repeated);
  reset(is_repeat0, sizeof is_repeat0);
  reset(is_repeat1, sizeof is_repeat1);
  reset(is_repeat2, sizeof is_repeat2);
  reset(is_long_repeat[0], sizeof is_long_repeat);
  reset(slots[0], sizeof slots);
  reset(distances, sizeof distances);
  reset(alignment, sizeof alignment);
  reset(match_lengths, sizeof match_lengths);
  reset(repeat_lengths, sizeof repeat_lengths);
  reset(literals, sizeof literals);
  uint32_t state = 0;
  uint32_t repeat[4] = {0, 0, 0, 0};
  for (uint32_t to = 0; to < size;) {
    const uint32_t place = to & place_mask;
    if (!bit(&is_match[state][place])) {
      const uint32_t before = to > 0 ? out[to - 1] : 0;
      uint16_t* const tree =
          literals + 0x300 * (((to & literal_mask) << literal_context) + (before >> (8 - literal_context)));
      uint32_t symbol = 1;
      if (state >= 7) {
        // After a match the byte that it would have gone on with says something.
        uint32_t expected = out[to - repeat[0] - 1];
        uint32_t same = 1;
        while (same && symbol < 0x100) {
          const uint32_t wanted = (expected >> 7) & 1;
          expected <<= 1;
          const uint32_t b = bit(tree + ((1 + wanted) << 8) + symbol);
          symbol = (symbol << 1) | b;
          same = b == wanted;
        }
      }
      while (symbol < 0x100) {
        symbol = (symbol << 1) | bit(tree + symbol);
      }
      out[to++] = (uint8_t)symbol;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    uint32_t count;
    if (!bit(&is_repeated[state])) {
      repeat[3] = repeat[2];
      repeat[2] = repeat[1];
      repeat[1] = repeat[0];
      count = length(match_lengths, place);
      state = state < 7 ? 7 : 10;
      const uint32_t slot = number(slots[count < 5 ? count - 2 : 3], 6);
      uint32_t distance = slot;
      if (slot >= 4) {
        const uint32_t bits = (slot >> 1) - 1;
        distance = (2 | (slot & 1)) << bits;
        distance += slot < 14 ? reversed(distances + distance - slot, bits)
                              : (direct(bits - 4) << 4) + reversed(alignment, 4);
      }
      repeat[0] = distance;
    } else {
      uint32_t which = 0;
      if (!bit(&is_repeat0[state])) {
        if (!bit(&is_long_repeat[state][place])) {
          state = state < 7 ? 9 : 11;
          out[to] = out[to - repeat[0] - 1];
          ++to;
          continue;
        }
      } else if (!bit(&is_repeat1[state])) {
        which = 1;
      } else {
        which = 2 + bit(&is_repeat2[state]);
      }
      const uint32_t distance = repeat[which];
      for (; which > 0; --which) {
        repeat[which] = repeat[which - 1];
      }
      repeat[0] = distance;
      count = length(repeat_lengths, place);
      state = state < 7 ? 8 : 11;
    }
    for (const uint32_t end = count < size - to ? to + count : size; to < end; ++to) {
      out[to] = out[to - repeat[0] - 1];
    }
  }
}
