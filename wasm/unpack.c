// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks LZMA in the page of the studio, before the program is there: browsers by themselves unpack deflate
// alone, which is a third larger. The stream is a raw one (xz --format=raw --lzma1=lc=LC,lp=LP,pb=PB), whose
// settings and size the page knows. How it is coded is described in doc/lzma-specification.txt of the LZMA
// SDK; names are those of there.

/// So that where the stream is can be kept in registers, which is a quarter faster.
#define INLINE inline __attribute__((always_inline))

typedef unsigned char Byte;
typedef unsigned short Chance;
typedef unsigned Word;

enum {
  page_bytes = 65536,
  half = 1024,  // of 2048: what a bit is taken for before any was seen
  // Where the chances of each kind of bit begin. A code of lengths takes 514: choices, 16 trees of 3 bits
  // twice, one of 8.
  is_match = 0,
  is_rep = 192,
  is_rep_first = 204,
  is_rep_second = 216,
  is_rep_third = 228,
  is_rep_short = 240,
  slots = 432,
  distances = 688,
  aligned = 816,
  lengths = 832,
  rep_lengths = 1352,
  literals = 1984,
  chances = literals + (0x300 << (LC + LP)),
};

extern Byte __heap_base;
static Chance chance[chances];
static Byte* out;

/// Where the stream is.
typedef struct {
  const Byte* in;
  Word range, code;
} Coder;

static Coder coder;
static Word size, state, rep0, rep1, rep2, rep3;

static INLINE Word bit(Coder* c, Word which) {
  const Word zero = chance[which];
  const Word bound = (c->range >> 11) * zero;
  Word value = 0;
  if (c->code < bound) {
    c->range = bound;
    chance[which] = (Chance)(zero + ((2048 - zero) >> 5));
  } else {
    c->range -= bound;
    c->code -= bound;
    chance[which] = (Chance)(zero - (zero >> 5));
    value = 1;
  }
  if (c->range < 1U << 24) {
    c->range <<= 8;
    c->code = c->code << 8 | *c->in++;
  }
  return value;
}

static INLINE Word tree(Coder* c, Word base, Word bits) {
  Word node = 1;
  for (Word i = 0; i < bits; ++i) {
    node = node << 1 | bit(c, base + node);
  }
  return node - (1U << bits);
}

static INLINE Word reverse_tree(Coder* c, Word base, Word bits) {
  Word node = 1;
  Word value = 0;
  for (Word i = 0; i < bits; ++i) {
    const Word one = bit(c, base + node);
    node = node << 1 | one;
    value |= one << i;
  }
  return value;
}

static INLINE Word even_bits(Coder* c, Word bits) {
  Word value = 0;
  for (; bits > 0; --bits) {
    c->range >>= 1;
    value <<= 1;
    if (c->code >= c->range) {
      c->code -= c->range;
      value |= 1;
    }
    if (c->range < 1U << 24) {
      c->range <<= 8;
      c->code = c->code << 8 | *c->in++;
    }
  }
  return value;
}

static INLINE Word length_of(Coder* c, Word base, Word place) {
  if (bit(c, base) == 0) {
    return 2 + tree(c, base + 2 + (place << 3), 3);
  }
  return bit(c, base + 1) == 0 ? 10 + tree(c, base + 130 + (place << 3), 3) : 18 + tree(c, base + 258, 8);
}

static INLINE Word distance_of(Coder* c, Word length) {
  const Word slot = tree(c, slots + ((length < 5 ? length - 2 : 3) << 6), 6);
  if (slot < 4) {
    return slot;
  }
  const Word bits = (slot >> 1) - 1;
  const Word high = (2 | (slot & 1)) << bits;
  return slot < 14 ? high + reverse_tree(c, distances + high - slot - 1, bits)
                   : high + (even_bits(c, bits - 4) << 4) + reverse_tree(c, aligned, 4);
}

static INLINE void literal(Coder* c) {
  const Word before = size > 0 ? out[size - 1] : 0;
  const Word base = literals + 0x300 * (((size & ((1U << LP) - 1)) << LC) + (before >> (8 - LC)));
  Word symbol = 1;
  if (state >= 7) {
    // Behind a match: as long as the bits are those of the byte that would have gone on, it helps to guess.
    Word matched = out[size - rep0 - 1];
    Word expected = 0;
    Word found = 0;
    while (expected == found && symbol < 0x100) {
      expected = matched >> 7 & 1;
      matched <<= 1;
      found = bit(c, base + ((1 + expected) << 8) + symbol);
      symbol = symbol << 1 | found;
    }
  }
  while (symbol < 0x100) {
    symbol = symbol << 1 | bit(c, base + symbol);
  }
  out[size++] = (Byte)symbol;
  state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
}

/// The distance that is used once more comes first of the last four.
static INLINE void repeat_distance(Coder* c) {
  Word distance = rep1;
  if (bit(c, is_rep_second + state) == 1) {
    distance = rep2;
    if (bit(c, is_rep_third + state) == 1) {
      distance = rep3;
      rep3 = rep2;
    }
    rep2 = rep1;
  }
  rep1 = rep0;
  rep0 = distance;
}

/// Makes room for so many bytes of both kinds. Where the packed ones belong.
__attribute__((export_name("begin"))) Byte* begin(Word packed, Word unpacked) {
  Byte* const place = &__heap_base;
  out = place + packed;
  const Word needed = ((Word)(out + unpacked) + 300 + page_bytes - 1) / page_bytes;
  const Word there = __builtin_wasm_memory_size(0);
  if (needed > there) {
    __builtin_wasm_memory_grow(0, needed - there);
  }
  for (Word i = 0; i < chances; ++i) {
    chance[i] = half;
  }
  coder = (Coder){place, 0, 0};
  size = state = rep0 = rep1 = rep2 = rep3 = 0;
  return place;
}

/// Goes on until there are so many bytes, and some more perhaps. Where the first one is.
__attribute__((export_name("unpack"))) const Byte* unpack(Word wanted) {
  Coder now = coder;
  Coder* const c = &now;
  if (now.range == 0) {
    now.range = 0xffffffffU;
    // The first byte is always zero.
    for (Word i = 0; i < 5; ++i) {
      now.code = now.code << 8 | *now.in++;
    }
  }
  while (size < wanted) {
    const Word place = size & ((1U << PB) - 1);
    if (bit(c, is_match + (state << 4) + place) == 0) {
      literal(c);
      continue;
    }
    Word length;
    if (bit(c, is_rep + state) == 0) {
      rep3 = rep2;
      rep2 = rep1;
      rep1 = rep0;
      length = length_of(c, lengths, place);
      state = state < 7 ? 7 : 10;
      rep0 = distance_of(c, length);
    } else {
      if (bit(c, is_rep_first + state) == 1) {
        repeat_distance(c);
      } else if (bit(c, is_rep_short + (state << 4) + place) == 0) {
        out[size] = out[size - rep0 - 1];
        ++size;
        state = state < 7 ? 9 : 11;
        continue;
      }
      length = length_of(c, rep_lengths, place);
      state = state < 7 ? 8 : 11;
    }
    for (; length > 0; --length, ++size) {
      out[size] = out[size - rep0 - 1];
    }
  }
  coder = now;
  return out;
}
