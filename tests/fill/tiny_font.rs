//! A font of our own making, of one letter.

/// A TrueType font of two glyphs: none, and an `o` of 1000 units: a square
/// ring whose hole is a circle of quadratic curves.
pub(crate) fn tiny_font() -> Vec<u8> {
    let words = |values: &[i32]| -> Vec<u8> {
        values.iter().flat_map(|value| (*value as i16).to_be_bytes()).collect()
    };
    // Outer square counterclockwise, inner octagon of off-curve points the
    // other way; with quadratic curves it is nearly a circle of radius 300.
    let outer = [[100, 0], [900, 0], [900, 800], [100, 800]].map(|p| (p, true));
    let turn = |i: i32| {
        let angle = f64::from(-i) * std::f64::consts::TAU / 8.0;
        let point = [500.0 + 325.0 * angle.cos(), 400.0 + 325.0 * angle.sin()];
        (point.map(|x: f64| x.round() as i32), false)
    };
    let points: Vec<([i32; 2], bool)> = outer.into_iter().chain((0..8).map(turn)).collect();
    let mut glyph = words(&[2, 100, 0, 900, 800, 3, 11, 0]);
    glyph.extend(points.iter().map(|(_, on_curve)| u8::from(*on_curve)));
    for axis in 0..2 {
        let mut last = 0;
        for (point, _) in &points {
            glyph.extend(words(&[point[axis] - last]));
            last = point[axis];
        }
    }
    let length = glyph.len().next_multiple_of(2);
    glyph.resize(length, 0);
    let mut head = words(&[1, 0, 0, 0, 0, 0, 0x5f0f, 0x3cf5, 0, 1000]);
    head.extend([0; 16]);
    head.extend(words(&[0, 0, 1000, 1000, 0, 8, 2, 0, 0]));
    let hhea = words(&[1, 0, 800, -200, 0, 1000, 0, 0, 1000, 1, 0, 0, 0, 0, 0, 0, 0, 2]);
    let maxp = words(&[0, 0x5000, 2]);
    let hmtx = words(&[500, 0, 1000, 100]);
    let loca = words(&[0, 0, (length / 2) as i32]);
    // One table of Unicode characters: 'o' is glyph 1.
    let cmap = words(&[0, 1, 0, 3, 0, 12, 6, 12, 0, i32::from(b'o'), 1, 1]);
    let tables: [(&[u8; 4], Vec<u8>); 7] = [
        (b"cmap", cmap),
        (b"glyf", glyph),
        (b"head", head),
        (b"hhea", hhea),
        (b"hmtx", hmtx),
        (b"loca", loca),
        (b"maxp", maxp),
    ];
    let mut file = words(&[1, 0, 7, 64, 2, 48]);
    let mut offset = 12 + 16 * tables.len();
    let mut body = Vec::new();
    for (name, table) in tables {
        file.extend(*name);
        file.extend([0; 4]);
        file.extend((offset as u32).to_be_bytes());
        file.extend((table.len() as u32).to_be_bytes());
        let padded = table.len().next_multiple_of(4);
        body.extend(&table);
        body.resize(body.len() + padded - table.len(), 0);
        offset += padded;
    }
    file.extend(body);
    file
}
