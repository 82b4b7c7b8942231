//! What all typed views share.
//!
//! Knows: how a view is cast. Must not know: any view.

/// Makes views of nodes, each of one kind.
macro_rules! views {
    ($($(#[$doc:meta])* $name:ident = $kind:ident,)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Clone, PartialEq, Eq, Hash)]
            pub struct $name($crate::SyntaxNode);

            impl $name {
                /// Views a node, if it is of this kind.
                pub fn cast(node: $crate::SyntaxNode) -> Option<Self> {
                    (node.kind() == $crate::SyntaxKind::$kind).then_some(Self(node))
                }

                /// The node.
                pub fn syntax(&self) -> &$crate::SyntaxNode {
                    &self.0
                }

                /// Bytes of the parsed text.
                pub fn range(&self) -> std::ops::Range<u32> {
                    $crate::byte_range(self.0.text_range())
                }
            }
        )*
    };
}

pub(super) use views;
