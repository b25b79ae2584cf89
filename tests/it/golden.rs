//! The formats are frozen: one digest each for `encode`, `encode_precise` and `decode` over fixed
//! inputs.
//!
//! A failure prints the new table, ready to paste. A digest that was released and changes is a
//! change of the format: CHANGELOG names it as one.

use std::fmt::Write;

use unitpack::Format;
use unitpack_test::codes::{decode_slice, encode_slice};
use unitpack_test::random::Rng;
use unitpack_test::{Arrays, Effort, Vector};

/// Of the inputs, so that a change to them is not taken for one to the formats: vectors, codes.
const INPUTS: [u64; 2] = [0x1F96_D4F6_3699_39F8, 0xA9DC_2D06_F422_E170];

/// Name; `encode`, `encode_precise`, `decode`.
#[rustfmt::skip]
const DIGESTS: &[(&str, [u64; 3])] = &[
    ("oct8", [0x794AF25E251035AE, 0x879698CDAE1FC4A6, 0x70EF1E1FAD998C67]),
    ("oct10", [0x6E2F00D36B9A453A, 0x64086EB93C97872E, 0x34C2A7C6FF4FB2D8]),
    ("oct12", [0x185C9F45E527E76E, 0x309235FE9A2BB072, 0x742B164595C3D6FE]),
    ("oct14", [0x0C77A38F1E585714, 0xEA1F12ECC4B13C65, 0xF4663314AE975A64]),
    ("oct16", [0xA9BEA91650B4A6C9, 0xC6CC74137381EFBF, 0xB9BF9917EFBE4993]),
    ("oct18", [0xB6CF9A4C0584E58D, 0x8C8CB84A7C79F779, 0x63A5DEED44708567]),
    ("oct20", [0x207F57ACBC317ACE, 0xF24BD63877CD18BD, 0x9CDD6FD02BC9CE3B]),
    ("oct22", [0x7512B09259F5095D, 0xF03C3A43DA12C14F, 0x230F447FDE9D8AA3]),
    ("oct24", [0xF56F13615F1E9151, 0x7E6777C7E1263141, 0xE95FC48DC46EA3F7]),
    ("oct26", [0x0E26D5E3E6E7914F, 0x10305DA9A5AF5D7A, 0x07CA140939963352]),
    ("oct28", [0x6694403628E4EC2A, 0xFF581AAC6565A7EC, 0x823436A0F2D5DCB5]),
    ("oct30", [0xDC5CBA783214A0BC, 0x46B58E30EE5F3855, 0x41D847406EBA638F]),
    ("oct32", [0x1EA5C2D18E625AA9, 0x2A4FB194ACA110C4, 0x93F9FF8BF3E4E496]),
    ("warpedoct16", [0xC525DAE47212EFEB, 0x67CC095A57B40E29, 0x2DD6D9A7D9F76AFC]),
    ("warpedoct20", [0x4CB577433C019EC4, 0xB48BBFD6CEB498BE, 0x04690FDF6A474FAA]),
    ("warpedoct22", [0xED162A02B5E08D87, 0xF4B855E47E87BD86, 0x800D09868F688C3D]),
    ("warpedoct24", [0x1F5625A4051545A4, 0x226F2AF9F8964C19, 0x36BC03F1D0076A96]),
    ("warpedoct32", [0x4AB0A56CC872A22A, 0xBFE01C53C0A8C267, 0x14C5B3E056105AE9]),
    ("eqareaoct16", [0x25089AC4F4AC5542, 0x59F55F06CE228782, 0x677A34F0296FA09A]),
    ("eqareaoct24", [0xC16CD4431B77B156, 0x2085A0530F5E7C37, 0x64B90CE803EAC70A]),
    ("eqareaoct32", [0x3890A167A4B686A2, 0x97458DA786FA77F3, 0x7333D921680B3849]),
    ("sixoct16", [0x50442F2D9411B6CB, 0xE61CCA9A646EF1DB, 0xD7E35F1450BF1FA6]),
    ("sixoct24", [0x73BD1541D188E6C7, 0x6AEA819BC2601FFB, 0x0E1A8C69C07FD32C]),
    ("sixoct32", [0xAC63501FBCFF09B5, 0x6E08DF7057EF902D, 0x869D544097FBF397]),
    ("frontoct16", [0xBFA14F5F5BAFCA8C, 0xE8A3D8AE3490388A, 0x00383C6A308B24A2]),
    ("frontoct24", [0xBF519E96D4FF1072, 0x4314452159623544, 0x7F7028A08301E8BC]),
    ("frontoct32", [0xE19E96F5D771C583, 0xC339A565A2C58599, 0x79639797235556F5]),
    ("quadfrontoct16", [0x92A21A318EC50E44, 0x678508C8F26F3974, 0x48235560612FE5C5]),
    ("quadfrontoct24", [0x4888D5B8078B079E, 0xE70E1FD737CB90E3, 0xE84DEC8669DA46DC]),
    ("snorm5x3", [0x2332EAFEF75A0A77, 0xBAD483FA5F49FAEE, 0x7712798A2F730F55]),
    ("snorm8x3", [0xC211DDBE5F6338BC, 0xFF97293EA606D5FF, 0xAC965A8E86133669]),
    ("snorm10x3", [0xA3933CF39F46EEDD, 0x7F6D4FB32861D4DC, 0xDCD9D57B5529BB65]),
    ("snorm11-11-10", [0xEEBBEF625C2E69FA, 0x086F2D65B2EC8CAB, 0xE10714FD72BCDFBD]),
    ("snorm16x3", [0x98058037B5F87914, 0x521120D8C65519B4, 0xB96232B63ED04B5D]),
    ("float16x3", [0x7B93CE0CCE8CB5A7, 0x8D6B390ECDA76E1E, 0x22BCB931BC96EE08]),
    ("float32x3", [0x04A837D822DBE45C, 0x04A837D822DBE45C, 0x4C1B93A850BBCBC0]),
    ("spherical16", [0x0AAAA040BA52FFB7, 0x4F4EAE9E46A94650, 0x2591AC759758E488]),
    ("spherical20", [0x7F65A18BB0E2D992, 0xFFABC9F21115ED0F, 0xED19A81C1EAAC697]),
    ("spherical22", [0x8ED3897DF394B99B, 0xE6C2020A4B6C1AAB, 0x99BE8DEB0B4335A1]),
    ("spherical24", [0x8F57AA5353DA40CC, 0xD2E1781849BEFB82, 0x8213C6708FB4AC58]),
    ("spherical32", [0xF0DB0FB335CC0B12, 0x851DD02639DFDF77, 0x26659C4839804C7E]),
    ("HemiOct16", [0xA1BA544BEF814BD0, 0x1948FC5FC6928922, 0xD0FA7C2EBC26971B]),
    ("HemiOct24", [0x9EE0377BF9129223, 0x49428CBC12148EF5, 0xF6139D5E8CC589C9]),
    ("HemiOct32", [0x36663B6BBAC110D3, 0x7302DDE901B1B155, 0x6DD54716991BB869]),
    ("signedoct17", [0xC18CC7A5F60B21C1, 0xD651033CF7C33F22, 0xE8007CB2322881EF]),
    ("signedoct21", [0x655957F155C22371, 0x46D0E1163076475A, 0xB6E599BC2A7C19ED]),
    ("signedoct23", [0xC007C4898A9B747D, 0x852B929D84F69013, 0xF8DF8F6B3B15CFDD]),
    ("signedoct31", [0xB182B5512C6BA2A6, 0x64CFEB638290A845, 0x36C13B9995AF0E2E]),
    ("XYOnly16", [0x4475E67424052EC5, 0x85B25A4D4C950929, 0x7E812C697DD6D9C2]),
    ("XYOnly24", [0xEFFEB588EFD121FF, 0x711533D5F49B1F59, 0x836F8B3210E10287]),
    ("XYOnly32", [0xC10B4FC03B13DA4D, 0x0A3AF948D003CB1C, 0x2C37AA80ADF1EF56]),
    ("XYOnly32F", [0x350CAAFC74E3400C, 0x33892FE46666237E, 0x197C0D2EE0E8C99C]),
    ("stereo16", [0x2E711B057A14E735, 0xAFE9A7A97E686264, 0x06D2DEE99B752BF2]),
    ("stereo20", [0xCC55365148C527D5, 0x37A2E5942C2DEFD2, 0x7673FCBED22D67B4]),
    ("stereo22", [0xF27E6E2EB061EB59, 0xB10DAE62D1856244, 0x87038F5015C9CD1F]),
    ("stereo24", [0x34B28C00BE760BB2, 0xC690BB90740421AA, 0xD72BF4FDD144EBF0]),
    ("stereo32", [0xAFFFF2785C2B3A6C, 0x564341F0F272F1EE, 0x1C96353301C353AF]),
    ("stereo+concentric16", [0x65FC6548118CBE4C, 0xB35EB943EF72000B, 0x563830136F118F5A]),
    ("stereo+concentric20", [0x8E24CC79553EBD31, 0xA6E6DB216FAB4E42, 0x5AE5485D0D445E23]),
    ("stereo+concentric22", [0x41A9350AF6955665, 0x41C864C5DFC3A9E8, 0xABAD647A207060AB]),
    ("stereo+concentric24", [0x3DAED9BDE895E5B3, 0x06414AAECFCFE6FD, 0xE4BBC48DAFF52F9A]),
    ("stereo+concentric32", [0x4C717ACFCD1D4656, 0xB51971CB20BD9867, 0xA4F8C688DACD3389]),
    ("stereo+ellipse16", [0x66000DD9F78A8AA3, 0x957D9B006E6F567F, 0x67B0AA9949431F43]),
    ("stereo+ellipse20", [0xD875AC2671B57A17, 0xBB391817ADDC6F1F, 0x871C373CAFFF2E9B]),
    ("stereo+ellipse22", [0x514E0276C3450955, 0xE80D54A5C6408748, 0x5E766C605EA2F594]),
    ("stereo+ellipse24", [0xDE88302C7DF1C329, 0x52C1A3A6D222EA2D, 0x68E7DB96754759A7]),
    ("stereo+ellipse32", [0xF9143FE49C192780, 0xA106ED64D2638D02, 0xF9954814E1B8BA8D]),
    ("eqarea16", [0x1A401519491F22A6, 0xCDD35B12BCA77EC0, 0x0B6355C033B21717]),
    ("eqarea20", [0xED5C39D19DA71C96, 0x0912E3F538EACB2C, 0x63B7FDFC09554CE1]),
    ("eqarea22", [0xD4610D800DC648FB, 0x3D60C58633E498D2, 0x709447642D09FDFA]),
    ("eqarea24", [0xA13A1A8752BDEFD7, 0x812915BEED10F417, 0x8FE68F092AF9B97E]),
    ("eqarea32", [0xB50CED5E57B958DB, 0xD4214691F3DD676A, 0x394778DC733F355E]),
    ("eqarea+concentric16", [0xFA40ED4BDDFECF47, 0x2D157B77DEA0BF7B, 0xD376B3C56353A81A]),
    ("eqarea+concentric20", [0x915F3D7A7B5A8ABA, 0x22530E036751D595, 0xA072D814738C5418]),
    ("eqarea+concentric22", [0xF3C3B270F7BCE23F, 0xE1041EA1B334E5BA, 0x0279DA2466DDC64B]),
    ("eqarea+concentric24", [0xEA3D2F65736C0AF0, 0x000DD6769822C66E, 0x5D4186D7ADD4D620]),
    ("eqarea+concentric32", [0x932F2FF10114F500, 0xE41098FB2EC42448, 0x8184D21DF4004329]),
    ("eqarea+ellipse16", [0xCFAF09362E087063, 0x4CD78443F16FC4AD, 0xCA6260A1A85FEC39]),
    ("eqarea+ellipse20", [0x6DC23010A92E2A89, 0x2F251BCCEC2E4A2E, 0x8E74B848E38FF8E7]),
    ("eqarea+ellipse22", [0xCC374AABB1D07C30, 0xFDD4D6DD095AC961, 0xDAFACE42B86D5305]),
    ("eqarea+ellipse24", [0x762006559DB3EF9E, 0xA27D6807381DE6A6, 0x8F0829D1971F4E45]),
    ("eqarea+ellipse32", [0x570774A30F009F29, 0x9483F75607A2C8D4, 0x962DA11D4AEAC298]),
    ("eqdist16", [0x698CCE5500A441C6, 0x5E6736CCACE9B897, 0x49674C4E45B0D14D]),
    ("eqdist20", [0xC704020FD930577E, 0xFA36924742AB5C71, 0x282B76AF618E92AA]),
    ("eqdist22", [0x144D836E8196402E, 0xD736201EE5490722, 0x9979FCE8FBC7B394]),
    ("eqdist24", [0x9197FE478B77E57D, 0xD61CC018825757F6, 0xA4BF95AC2D628FA8]),
    ("eqdist32", [0xB0F022B53D022370, 0x1D1FF76891DCD187, 0x00D76F2A6421B058]),
    ("eqdist+concentric16", [0x461312AFD3BFBA3B, 0xFF3E1EEF42B63651, 0x290797588B4BA428]),
    ("eqdist+concentric20", [0x148A3B62590CBD2A, 0x255E417A2CFC252E, 0x988E382D2A59625D]),
    ("eqdist+concentric22", [0x92385EF0A48EE1FF, 0xE748294877FF266A, 0x41E161CF07CD3CBC]),
    ("eqdist+concentric24", [0x744E59B7402FE30B, 0x16056CD467CF7B56, 0x9977FD95C3732FF2]),
    ("eqdist+concentric32", [0xA30182CACB273C1B, 0x2E39C47840C2096A, 0xD67A437AB615A25F]),
    ("eqdist+ellipse16", [0x83D4D52872996DC6, 0x94AE29980EC78CC6, 0x7EC9CF8F99854DAB]),
    ("eqdist+ellipse20", [0x0D50FCA5F99FF8B4, 0x06EEC21CAEA384BB, 0x82D20D9EC1549BCE]),
    ("eqdist+ellipse22", [0x49F967FC53800035, 0xB1E5B3E149323358, 0xF1F339FDA90CF234]),
    ("eqdist+ellipse24", [0xD3454813CE1000E4, 0x4C99F2619184C9B4, 0x1636779348CD02C5]),
    ("eqdist+ellipse32", [0x70AC55E569312942, 0x382B6EC8E13CCC78, 0x9BC33192CE621B48]),
    ("latlong16", [0x1EAC2C14AF89A135, 0x9D01993BEFBA29DF, 0xBFB616FDDAA3210A]),
    ("latlong24", [0x00C880E36C6A9B26, 0xB35D07F51A3E8FBD, 0x403A6A24AC1F7DE6]),
    ("latlong32", [0x2E09127A60AB6D25, 0x30F871D2CBC40AA2, 0x8F80AF4E70DD0A32]),
    ("latlong16D", [0xAF24C34EDAC02D05, 0x413092761D5179A9, 0xFCFA9435684D5CD8]),
    ("latlong24D", [0xCE1DF7917C1D2C34, 0x1CF38EE5F736C80C, 0xCAB797EB63902AD6]),
    ("latlong32D", [0x3A7187A49226E4AB, 0x41DC62BEBFF4DEAF, 0x21514B4F7F86C2CB]),
    ("fibonacci16", [0xE9D8E4CCFF8DC826, 0xE9D8E4CCFF8DC826, 0xF89E6782A83D83C7]),
    ("fibonacci24", [0x9CC5956C37AE726A, 0x9CC5956C37AE726A, 0x65CEBD5DC823EC64]),
    ("cube16", [0x05E268BBE8C1C05C, 0x56499865D6CF0D3A, 0xBB840E56D3759877]),
    ("cube24", [0x5E7358C57E46EE05, 0x1891ADBF5A34C92D, 0x1315A55124E898F8]),
    ("cube32", [0x03BC1F63433546AE, 0x7B117A97EF79BFAF, 0xC58708CA6AE7D208]),
    ("warpedcube16", [0x7A4ACA5F4759A53C, 0x563CC7DBD426859C, 0xE41B198F6284E56B]),
    ("warpedcube24", [0x393F557C8F5F7029, 0x382DB97411C74DE1, 0xA7E343530F22BE5A]),
    ("warpedcube32", [0x5A52D07A0A2194E4, 0x92C05AEA77376E76, 0x0A6A9106C29B3E61]),
    ("angularcube4", [0xA2156BA5D07D83A1, 0xA2156BA5D07D83A1, 0x361936AEE2A08A65]),
    ("angularcube5", [0xCCFF35CB14AD04BB, 0x13429D047581D81D, 0x3EA00702BB8848B5]),
    ("angularcube6", [0xEC004E1357D08B91, 0xC9AA59FDC2EB32D3, 0x2CEBA32DC53C76DF]),
    ("angularcube7", [0x32C776FA4274129F, 0x50465079B12843BD, 0xDB3034F0E2F52CC9]),
    ("angularcube8", [0xD0F077C6F89CD2D5, 0x528BD68F4CD6E487, 0x0304242AC46EC649]),
    ("angularcube9", [0x3896C43E857E8EF7, 0xF725D476E40ED627, 0x367943C62684EF25]),
    ("angularcube10", [0xA2CE9AAAF02D90E0, 0xA62FFB26A1028A18, 0x1115DCF507A34843]),
    ("angularcube11", [0xD31BB083FF98051B, 0xB0DC6E40811D9D3B, 0x2D2A1DFAC7A26A90]),
    ("angularcube12", [0xE428B73487DBC32C, 0x58007A165EAA1329, 0x7791C81C8B237972]),
    ("angularcube13", [0x03BFEA99AF72A35E, 0x93B8BB4F753FE97B, 0x2980C1A6118A3EEA]),
    ("angularcube14", [0x483A4CD483E010CF, 0x763AA5910B2D7023, 0xD717E93547C7B5D6]),
    ("angularcube15", [0xBE4267DC8C1433BF, 0x4B2814146F9D215F, 0xBAEC8AB9E32C781A]),
    ("angularcube16", [0x8F83A5BA26842258, 0x81F2E4BABD45BE39, 0xB0F77958C0580851]),
    ("angularcube17", [0xE88AF5EC85638DC1, 0x17608339E5EDDE2A, 0x24C6F393C1F04312]),
    ("angularcube18", [0x27725E76AFA6E6C7, 0x5895233607EE2D2E, 0x54E936F4079710C4]),
    ("angularcube19", [0x044BCB2C192ED854, 0x8D61A8BA1F388E56, 0xEB20F03135879451]),
    ("angularcube20", [0x351922A885259E9D, 0xEB3713FE5337C3DF, 0x51542AE288A98F51]),
    ("angularcube21", [0x0FC62BF01ABDF12E, 0x617891F60F25289D, 0x50F8136737BAB60C]),
    ("angularcube22", [0xBC955156C7558D42, 0xDC62A032429D10DA, 0x798BD6F72CACC46D]),
    ("angularcube23", [0xD949231B21923DAD, 0x25FD904EB644BD33, 0x80866E1A501A3339]),
    ("angularcube24", [0xA527DB5DBD9276AE, 0x10AD48130D4EBB2E, 0xA0ED7CF75CAAEF1D]),
    ("angularcube25", [0x0DA6B630686BC126, 0xB896AD0F2E0074E8, 0x27E57A2A92CBD115]),
    ("angularcube26", [0x763CE4F26A9E1262, 0x248366A8BE493117, 0x17C7FFA9E3F5F718]),
    ("angularcube27", [0xCF5635E78FED94A3, 0x4898CB9CA4818760, 0x57B765A4D51582F6]),
    ("angularcube28", [0xABB81085C460DF63, 0x7A193BB1AEC953F7, 0x7EDF0DC195E351B0]),
    ("angularcube29", [0xF883EBCE643B79F7, 0x6F1F972E7AE71302, 0xD31FEF2573CCE64D]),
    ("angularcube30", [0x0FD488D02E11EC69, 0x1DFAB4804D8D99B7, 0x51D94370395FA116]),
    ("angularcube31", [0xFB46D988CDB250F0, 0x83A6CE9A9C6CAF7E, 0x62AA761DB08F8884]),
    ("angularcube32", [0x69D6F484C0A19602, 0x8A5B3EBF23F4FC60, 0xDC65B5336567B91E]),
    ("octant16", [0x3A1935ABE717077C, 0x0D1597CE3CD24C57, 0xE333793FF6081318]),
    ("xyz-unorm8x3", [0xBCA0B9645E68411E, 0x2EF4E3AF93777538, 0xF29CCB85B3B12F12]),
    ("xyz-unorm16x3", [0x5F4AAED95C2AFD88, 0xCFDD23E11EA3D965, 0x2FB7CBA2195079F2]),
    ("CrytekBFN24", [0xC40D687976A93BEC, 0x2EF4E3AF93777538, 0xF29CCB85B3B12F12]),
    ("phi-z-unorm8x2", [0x3D86BE923B38D605, 0x4DBB5BAF75E47786, 0xBDB16D1A73817836]),
    ("phi-z-unorm16x2", [0x93DB43E1EFE0D9E3, 0x71D4852EF42CB7ED, 0x9BC4E63913984BCF]),
    ("oct-unorm8x2", [0x5F45DD17CAA28216, 0x0D2DE60C916D5E05, 0x6C15878298FD31B5]),
    ("oct-unorm16x2", [0x3569A53536C6E079, 0x07DEB42957EE90B2, 0x015FCA282AAA679E]),
    ("icosphere162", [0xB9863B8FCDCA0229, 0xB9863B8FCDCA0229, 0xF31C4101531AA3C5]),
];

/// FNV-1a, 64 bits.
fn digest(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3)
    })
}

/// Of the bits of floats, one component of all vectors after another. All NaN count as one, since moving
/// them changes their bits on some machines.
fn digest_arrays(v: &Arrays) -> u64 {
    let bits = |c: &f32| if c.is_nan() { 0x7FC0_0000 } else { c.to_bits() };
    digest(v.x.iter().chain(&v.y).chain(&v.z).flat_map(|c| bits(c).to_le_bytes()))
}

/// Made of exact operations only.
fn vectors() -> Vec<Vector> {
    let mut vectors = Vec::new();
    let mut random = Rng::new(1);

    // Axes, faces, diagonals, zeros of both signs, and what is no direction.
    let odd = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-40, -1e-40, 3e38, f32::INFINITY, f32::NEG_INFINITY];
    for x in odd {
        for y in odd {
            vectors.extend(odd.map(|z| [x, y, z]));
        }
    }
    let nan = f32::from_bits(0x7FC0_0000);
    vectors.extend([[nan, 0.0, 1.0], [1.0, nan, f32::INFINITY], [nan, nan, nan]]);

    // Ties of a component, of two, and of both parameters of the octahedral square; and beside
    // them.
    for bits in 4..=16 {
        let steps = ((1 << bits) - 1) as f32;
        for _ in 0..24 {
            let mut tie = || ((random.signed() * steps).floor() + 0.5) / steps;
            let (a, b) = (tie(), tie());
            let c = 1.0 - a.abs() - b.abs();
            let round = [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()];
            let [x, y, z] = if c >= 0.0 {
                [a, b, c]
            } else {
                [(1.0 - b.abs()).copysign(a), (1.0 - a.abs()).copysign(b), c]
            };
            vectors.extend([[a, b, 1.0], round, [b, round[2], a], [x, y, z]]);
            vectors.extend([[x.next_up(), y, z], [x, y.next_down(), z], [x, y, -z]]);
        }
    }

    // Small, large and usual directions, and any bits.
    for scale in [1e-40, 1e-15, 1e15, 1e38] {
        vectors.extend((0..64).map(|_| [(); 3].map(|()| random.signed() * scale)));
    }
    vectors.extend((0..3000).map(|_| [(); 3].map(|()| random.signed())));
    vectors.extend((0..500).map(|_| {
        [(); 3]
            .map(|()| f32::from_bits(random.bits() as u32))
            .map(|c| if c.is_nan() { nan } else { c })
    }));
    vectors
}

/// Bytes of codes: runs of one byte, then random ones. A multiple of every size of code up to 12
/// bytes.
fn codes() -> Vec<u8> {
    let mut random = Rng::new(2);
    let runs = (0..=255).flat_map(|byte| [byte; 24]);
    runs.chain((0..48_000).map(|_| (random.bits() >> 56) as u8)).collect()
}

fn encode(vectors: &[Vector], format: Format, effort: Effort) -> u64 {
    // The search of these is slow: a part will do.
    let slow = matches!(format, Format::Snorm16x3 | Format::Float16x3);
    let every = if slow && effort == Effort::Precise { 16 } else { 1 };
    let v: Arrays = vectors.iter().copied().step_by(every).collect();
    let mut bytes = vec![0; v.count() * format.code_size()];
    encode_slice(format, effort, v.read(), &mut bytes).unwrap();
    digest(bytes)
}

fn decode(codes: &[u8], format: Format) -> u64 {
    let mut v = Arrays::unwritten([codes.len() / format.code_size(); 3]);
    decode_slice(format, codes, v.write()).unwrap();
    digest_arrays(&v)
}

#[test]
fn digests_have_not_changed() {
    let (vectors, codes) = (vectors(), codes());
    let inputs = [digest_arrays(&Arrays::from(&vectors[..])), digest(codes.iter().copied())];
    assert_eq!(inputs, INPUTS, "the inputs changed: {inputs:#018X?}");

    let got: Vec<_> = Format::ALL
        .iter()
        .map(|&format| {
            let [fast, precise] = Effort::BOTH.map(|effort| encode(&vectors, format, effort));
            (format.name(), [fast, precise, decode(&codes, format)])
        })
        .collect();
    if got == DIGESTS {
        return;
    }

    let mut message = String::new();
    for (name, _) in DIGESTS.iter().filter(|(name, _)| Format::from_name(name).is_none()) {
        writeln!(message, "{name} is gone").unwrap();
    }
    for (name, digests) in &got {
        match DIGESTS.iter().find(|(pinned, _)| pinned == name) {
            None => writeln!(message, "{name} is new").unwrap(),
            Some((_, pinned)) => {
                let what = ["encode", "encode_precise", "decode"];
                for ((what, pinned), digest) in what.iter().zip(pinned).zip(digests) {
                    if pinned != digest {
                        writeln!(message, "{what} of {name} changed").unwrap();
                    }
                }
            }
        }
    }
    let mut table = String::new();
    for (name, [encode, precise, decode]) in got {
        writeln!(table, "    ({name:?}, [{encode:#018X}, {precise:#018X}, {decode:#018X}]),")
            .unwrap();
    }
    panic!(
        "A changed digest is a change of the format: name it in CHANGELOG.\n{message}\n\
         const DIGESTS: &[(&str, [u64; 3])] = &[\n{table}];"
    );
}
